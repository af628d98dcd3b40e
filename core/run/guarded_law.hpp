// SPDX-License-Identifier: BSD-3-Clause
/// A contact law whose exceptions reach the caller of the engine. The engine calls laws from many threads, out of which
/// no exception can go: it would end the program.
#pragma once

#include <exception>
#include <memory>
#include <mutex>

#include "breccia/contact_law.hpp"
#include "config/places.hpp"
#include "plugin/guarded.hpp"

namespace breccia {

class GuardedLaw final : public ContactLaw {
  template <class F>
  decltype(auto) call(std::string_view doing, F&& f) const {
    return calling({ContactLaw::kind, type_}, doing, std::forward<F>(f));
  }

 public:
  /// `section`: where the workflow speaks of it, for what the law refuses of a specimen; empty where nobody wrote it.
  GuardedLaw(std::unique_ptr<ContactLaw> law, std::string type, std::string section = {})
      : law_(std::move(law)), type_(std::move(type)), section_(std::move(section)) {}

  std::vector<ColumnDoc> columns() const override {
    return call("naming its history", [&] { return law_->columns(); });
  }
  bool has_moments() const override {
    return call("describing itself", [&] { return law_->has_moments(); });
  }
  bool makes_bonds() const override {
    return call("describing itself", [&] { return law_->makes_bonds(); });
  }
  bool needs_mass() const override {
    return call("describing itself", [&] { return law_->needs_mass(); });
  }
  bool respects_protection() const override {
    return call("describing itself", [&] { return law_->respects_protection(); });
  }
  void prepare(const Assembly& assembly) override {
    set_up("deriving its constants", [&] { law_->prepare(assembly); });
  }
  void take_kinds(std::span<ContactLaw* const> of_kind) override {
    std::vector<ContactLaw*> bare;
    for (ContactLaw* law : of_kind) bare.push_back(static_cast<GuardedLaw*>(law)->law_.get());
    set_up("taking the laws of its materials", [&] { law_->take_kinds(bare); });
  }
  void scatter(const std::vector<std::string>& parameters) override {
    call("taking what scatters", [&] { law_->scatter(parameters); });
  }
  Results derived() const override {
    return call("deriving its constants", [&] { return law_->derived(); });
  }
  void initialise(const PairChunk& chunk, double* const* history) override {
    keep("beginning the history of pairs", [&] { law_->initialise(chunk, history); });
  }
  void evaluate(const PairChunk& chunk, double* const* history, PairAnswer& answer, bool adds) override {
    keep("giving forces", [&] { law_->evaluate(chunk, history, answer, adds); });
  }
  void stiffness(const PairChunk& chunk, double* const* history, ContactStiffness* of_pair) override {
    keep("giving stiffnesses", [&] { law_->stiffness(chunk, history, of_pair); });
  }
  void energy(const PairChunk& chunk, double* const* history, double* of_pair) override {
    keep("giving energies", [&] { law_->energy(chunk, history, of_pair); });
  }
  ContactForce answer(const PairChunk& chunk, std::size_t k, double* const* history) override {
    return call("giving forces", [&] { return law_->answer(chunk, k, history); });
  }

  /// Throws what the law has thrown in calls of the engine.
  void check() {
    if (fault_) std::rethrow_exception(std::exchange(fault_, nullptr));
  }
  bool has_failed() const { return failed_; }

 private:
  template <class F>
  void set_up(std::string_view doing, F&& f) {
    try {
      call(doing, std::forward<F>(f));
    } catch (const PluginFault& e) {
      if (section_.empty()) throw;
      throw AtPath(section_, e.what());
    }
  }
  template <class F>
  void keep(std::string_view doing, F&& f) noexcept {
    try {
      call(doing, std::forward<F>(f));
    } catch (...) {
      const std::lock_guard one_at_a_time(mutex_);
      if (!fault_) fault_ = std::current_exception();
      failed_ = true;
    }
  }
  std::unique_ptr<ContactLaw> law_;
  std::string type_, section_;
  std::mutex mutex_;
  std::exception_ptr fault_;
  bool failed_ = false;
};

}  // namespace breccia
