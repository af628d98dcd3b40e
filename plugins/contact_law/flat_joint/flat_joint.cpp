// SPDX-License-Identifier: BSD-3-Clause
/// The plugin: the law for the layout that the configuration asks for, and which of its contacts are bonded, gapped or
/// slits.
#include "flat_joint.hpp"

namespace breccia::flat_joint {
namespace {

std::unique_ptr<ContactLaw> make(const Config& c) {
  switch (c.elements) {
    case Elements::line_2:
      return make_law<Line<2>>(c);
    case Elements::line_4:
      return make_law<Line<4>>(c);
    case Elements::line_8:
      return make_law<Line<8>>(c);
    case Elements::disc_1x3:
      return make_law<Disc<1, 3>>(c);
    case Elements::disc_1x4:
      return make_law<Disc<1, 4>>(c);
    case Elements::disc_2x4:
      return make_law<Disc<2, 4>>(c);
  }
  return nullptr;
}

class FlatJoint final : public ContactLaw {
 public:
  using Config = flat_joint::Config;
  static void describe(Schema<Config>& s) { ContactLawOf<Law<Line<2>>>::describe(s); }  // the same for all
  explicit FlatJoint(const Config& c) : config_(c), law_(make(c)), of_kind_{c} {}

  std::vector<ColumnDoc> columns() const override { return law_->columns(); }
  bool has_moments() const override { return law_->has_moments(); }
  bool needs_mass() const override { return law_->needs_mass(); }
  bool respects_protection() const override { return law_->respects_protection(); }
  void prepare(const Assembly& assembly) override { law_->prepare(assembly); }
  void take_kinds(std::span<ContactLaw* const> of_kind) override {
    std::vector<ContactLaw*> laws;
    of_kind_.clear();
    for (ContactLaw* law : of_kind) {
      auto* const one = static_cast<FlatJoint*>(law);
      if (one->config_.elements != config_.elements)
        throw UserError("contact_law flat_joint: `elements` must be the same under `between` as for all other pairs");
      laws.push_back(one->law_.get());
      of_kind_.push_back(one->config_);
    }
    law_->take_kinds(laws);
  }
  void scatter(const std::vector<std::string>& parameters) override {
    const auto at = std::find(parameters.begin(), parameters.end(), "lot");
    lot_column_ = at == parameters.end() ? 0 : columns().size() + std::size_t(at - parameters.begin());
    // The lot is drawn once and no constant of the step loop: alone it leaves that loop as it is.
    law_->scatter(lot_column_ && parameters.size() == 1 ? std::vector<std::string>() : parameters);
  }
  void initialise(const PairChunk& chunk, double* const* history) override {
    law_->initialise(chunk, history);
    for (std::size_t k = 0; k < chunk.size; ++k) {
      const Config& c = of_kind_[of_kind_.size() == 1 ? 0 : chunk.kind[chunk.mixed ? k : 0]];
      const double lot = c.lot * (lot_column_ ? history[lot_column_][k] : 1.0);
      if (chunk.intact[k] < 0.5 || lot <= c.bonded_share) continue;
      history[bonded_elements_column][k] = history[bonded_share_column][k] = 0;
      history[gap_column][k] = lot <= c.bonded_share + c.gapped_share ? c.gap : 0;
    }
  }
  void evaluate(const PairChunk& chunk, double* const* history, PairAnswer& answer, bool adds) override {
    law_->evaluate(chunk, history, answer, adds);
  }
  void stiffness(const PairChunk& chunk, double* const* history, ContactStiffness* of_pair) override {
    law_->stiffness(chunk, history, of_pair);
  }
  void energy(const PairChunk& chunk, double* const* history, double* of_pair) override {
    law_->energy(chunk, history, of_pair);
  }
  ContactForce answer(const PairChunk& chunk, std::size_t k, double* const* history) override {
    return law_->answer(chunk, k, history);
  }
  Results derived() const override { return law_->derived(); }

 private:
  Config config_;
  std::unique_ptr<ContactLaw> law_;
  std::vector<Config> of_kind_;  ///< of pairs; one for all where there is but one kind
  std::size_t lot_column_ = 0;   ///< of what each bond drew over the mean; 0: nothing is drawn
};

}  // namespace
}  // namespace breccia::flat_joint

BRECCIA_PLUGIN(breccia::flat_joint::FlatJoint, "contact_law", "flat_joint")
