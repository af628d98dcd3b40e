// SPDX-License-Identifier: BSD-3-Clause
/// Dense sphere packing by nonlinear least squares, after Labra & Oñate (2009).
#pragma once

#include "config.hpp"

namespace breccia::labra_onate {

class LabraOnate final : public Packing {
 public:
  using Config = labra_onate::Config;
  static void describe(Schema<Config>& s) { labra_onate::describe(s); }

  explicit LabraOnate(const Config& config) : config_(config) {}
  std::string why_not(const PackingRequest& request) const override { return why_not_in(config_.container, request); }
  PackedParticles generate(const PackingRequest& request, Host& host) override;

 private:
  Config config_;
};

}  // namespace breccia::labra_onate
