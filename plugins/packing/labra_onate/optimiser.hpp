// SPDX-License-Identifier: BSD-3-Clause
/// From random places to the packing: growth, then least squares with free radii, then with the final radii.
#pragma once

#include <optional>
#include <random>

#include "breccia/services.hpp"
#include "least_squares.hpp"

namespace breccia::labra_onate {

struct OptimiserSettings {
  std::size_t pairs = 0;     ///< of the neighbour set
  int max_iterations = 200;  ///< of each stage
  double tolerance = 1e-4;   ///< a stage ends when the energy falls by less than this share, three times in a row
  int threads = 1;
  std::optional<double> size_correlation = {};  ///< of neighbours, to be set up between arranging and optimising
};

/// The energy of a stage after each accepted step, and how it ended.
struct StageRecord {
  std::vector<double> energy;
  bool converged = false;
};

class Optimiser {
 public:
  /// `radii`: the final ones, ascending [m]. Which sphere gets which is decided on the way.
  Optimiser(const Container& box, std::vector<double> radii, const OptimiserSettings& settings, Host& host)
      : box_(box), radii_(std::move(radii)), settings_(settings), finder_(box, settings.threads), host_(host) {}

  /// Random places, radii grown to full size while overlaps are pushed apart; then, if asked, radii swapped until
  /// neighbours are as alike in size as they should be.
  Spheres arrange(std::uint64_t seed);
  /// Centres and radii; after each step the radii are mapped, rank by rank, to the ones asked for.
  StageRecord optimise_all(Spheres& s);
  /// Centres alone.
  StageRecord optimise_centres(Spheres& s);

 private:
  struct Stage {
    Residual form;
    bool radii_free;
    std::size_t pairs;
    int max_iterations;
    double share_begin, share_end;  // of the whole work, for the progress bar
  };
  struct Candidate {
    Spheres s;
    NeighbourSet set;
    double energy;
  };
  StageRecord run(Spheres& s, const Stage& stage);
  Candidate settle(Spheres s, const Stage& stage);
  Spheres moved(const Candidate& from, const std::vector<Vec4>& step, const Stage& stage) const;

  const Container& box_;
  std::vector<double> radii_;
  OptimiserSettings settings_;
  NeighbourFinder finder_;
  Host& host_;
};

}  // namespace breccia::labra_onate
