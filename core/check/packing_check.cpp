// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <ctime>

#include "check/attempt.hpp"
#include "check/check.hpp"
#include "check/example.hpp"
#include "check/made_parts.hpp"
#include "check/names.hpp"
#include "check/packing_cases.hpp"
#include "check/packing_measures.hpp"
#include "engine/specimen.hpp"
#include "results/temporary_folder.hpp"

namespace breccia {
namespace {

class PackingHost final : public SilentHost {
 public:
  explicit PackingHost(const Host& user, int threads = 1, double cancel_after = 1e9)
      : user_(user), threads_(threads), until_(cancel_after) {}
  int threads() const override { return threads_; }
  bool cancelled() const override {
    ++asked;
    return seconds() >= until_ || user_.cancelled();
  }
  /// Of the processor: others on the machine have no part in it.
  double seconds() const { return double(std::clock() - start_) / CLOCKS_PER_SEC; }
  mutable std::atomic<long> asked = 0;

 private:
  const Host& user_;
  int threads_;
  double until_;
  std::clock_t start_ = std::clock();
};

class PackingCheck {
 public:
  PackingCheck(const Registry& registry, const std::string& name, const std::vector<std::string>& parameters,
               const Host& user)
      : registry_(registry),
        name_(name),
        folder_(std::filesystem::temp_directory_path(), "breccia-check"),
        user_(user),
        trials_(user) {
    cases_ = packing_cases(registry, name, parameters, folder_.path(), refused_);
  }

  CheckFindings operator()() {
    for (const auto& [where, why] : refused_) trials_.skip(makes, where, why);
    for (const PackingWays& ways : cases_) form(ways);
    if (!trials_.any())
      trials_.see(makes, "every form", false, "none was made", "give the parameters that it needs by `--set`");
    return trials_.findings();
  }

 private:
  static constexpr const char* makes = "makes a packing";

  /// Of the ways to ask for a form those that suit it.
  void form(const PackingWays& ways) {
    std::string why;
    bool any = false;
    for (const PackingCase& way : ways) {
      case_ = &way;
      std::string refusal;
      const Attempt made = attempt([&] {
        const auto packing = registry_.create<Packing>(way.choice);
        refusal = packing->why_not(way.request);
        if (refusal.empty() && way.request.repeats() && !packing->can_repeat())
          refusal = "`can_repeat` says that it cannot fill a space that repeats itself";
        reads_ = !packing->inputs().empty();
      });
      if (made && !refusal.empty()) {
        why = refusal;
        continue;
      }
      any = true;
      if (made) one_case();
      else see(makes, false, made.text, "a configuration that keeps to its ranges and to its own rules must do");
    }
    if (!any) trials_.skip(makes, ways.front().form, why);
  }

  void see(const char* check, bool holds, const std::string& measured, const char* mend, double badness = 0) {
    trials_.see(check, case_->name, holds, measured, mend, badness);
  }
  void see(const char* check, const std::string& fault, const std::string& fine, const char* mend) {
    see(check, fault.empty(), fault.empty() ? fine : fault, mend);
  }

  PackedParticles make(Host& host, std::uint64_t seed = 1) const {
    PackingRequest request = case_->request;
    request.seed = seed;
    return registry_.create<Packing>(case_->choice)->generate(request, host);
  }

  void one_case() {
    PackedParticles packed;
    PackingHost host(user_);
    const Attempt end = attempt([&] { packed = make(host); });
    const double seconds = host.seconds();
    if (end.end == Attempt::End::refused) return trials_.skip(makes, case_->name, end.text);
    see(makes, end ? fault_of_numbers(packed) : end.text, fmt::format("{} particles", packed.radius.size()),
        "a request that `why_not` lets pass must be met: finite centres, positive radii, as many of the one as of the "
        "other");
    if (!end || !fault_of_numbers(packed).empty()) return;
    const PackingMeasures m = measure_packing(packed, case_->request, case_->container);
    places(packed, m);
    shape(packed, m);
    radii(packed, m);
    report(packed, m);
    again(packed, m);
    in_shares(packed);
    cancelled(seconds, packed.radius.size());
    ranges();
  }

  static std::string fault_of_numbers(const PackedParticles& p) {
    if (p.radius.empty() || p.radius.size() != p.position.size())
      return fmt::format("{} centres and {} radii", p.position.size(), p.radius.size());
    for (std::size_t k = 0; k < p.radius.size(); ++k)
      if (!p.position[k].allFinite() || !std::isfinite(p.radius[k]) || !(p.radius[k] > 0))
        return fmt::format("particle {} of radius {} m is at ({}, {}, {})", k, p.radius[k], p.position[k].x(),
                           p.position[k].y(), p.position[k].z());
    for (const auto& [name, values] : p.columns) {
      if (values.size() != p.radius.size()) return fmt::format("column `{}` has {} values", name, values.size());
      for (const double v : values)
        if (!std::isfinite(v)) return "column `" + name + "` holds what is no number";
    }
    return {};
  }

  void places(const PackedParticles& packed, const PackingMeasures& m) {
    const PackingRequest& asked = case_->request;
    const bool margin = case_->choice.config.value("margin", 0.0) > 0;
    if (!m.overhang) trials_.skip("inside the container", "", "it has no parameter `container` of the SDK's form");
    else
      see("inside the container", *m.overhang <= (margin ? 1.0 : 1e-6),
          fmt::format("a particle reaches out by {:.2g} of its radius", *m.overhang),
          "keep every particle, not only its centre, within `Container::walls`; a cylinder stands on the origin, a box "
          "has x and y "
          "centred (in two dimensions y from 0)",
          1 + *m.overhang);
    see("no two in one place", m.nearest > 1e-6,
        fmt::format("the two nearest centres are {:.2g} radii apart", m.nearest),
        "two centres coincide: their contact would have no direction");
    if (asked.dimension == 2) {
      const double off = std::max(std::abs(m.low.z()), std::abs(m.high.z()));
      see("in the plane", off == 0, fmt::format("z is up to {:.2g} m", off), "z is 0 in two dimensions");
    }
    const auto line = std::find_if(packed.report.begin(), packed.report.end(),
                                   [](const AskedGot& l) { return l.name == "max_overlap"; });
    if (line != packed.report.end())
      see("overlaps", m.overlap <= line->got + 1e-9,
          fmt::format("up to {:.2g} of the sum of the radii, {:.2g} reported", std::max(0.0, m.overlap), line->got),
          asked.repeats() ? "look for pairs across the boundary: `for_each_pair_within` and `Space::branch` know them"
                          : "the report's `max_overlap` misses pairs",
          m.overlap);
    else if (m.overlap <= 1e-6) see("overlaps", true, "none", "");
    else
      trials_.skip("overlaps", case_->name,
                   "they overlap, and the report has no line `max_overlap` to hold that against");
    if (!asked.repeats()) return;
    std::string fault;
    for (int k = 0; k < 3; ++k) {
      const bool repeats = asked.periodic[std::size_t(k)];
      const double period = packed.period[k];
      if (repeats != (period > 0)) fault = fmt::format("along {} the period is {} m", "xyz"[k], period);
      else if (repeats && m.high[k] - m.low[k] > period * (1 + 1e-9))
        fault =
            fmt::format("along {} the centres spread over {:.4g} periods", "xyz"[k], (m.high[k] - m.low[k]) / period);
      else if (repeats && case_->container && std::abs(period / case_->container->size()[k] - 1) > 0.2)
        fault = fmt::format("along {} the period is {:.4g} m, where {:.4g} m were asked for", "xyz"[k], period,
                            case_ -> container -> size()[k]);
    }
    see("within one cell", fault, "period and centres agree",
        "`period` says after which length the packing repeats itself along the directions of the request, and all "
        "centres are "
        "within one such length");
  }

  /// As the engine will measure it from the particles.
  void shape(const PackedParticles& packed, const PackingMeasures& m) {
    Space space = case_->request;
    space.cell = Cell::box(packed.period);
    if (!packed.axis.allFinite() || std::abs(packed.axis.norm() - 1) > 1e-9)
      return see("shape of the specimen", false, "its axis is no unit vector", "set `axis`, a unit vector");
    const SpecimenShape s =
        measure_specimen(packed.position, packed.radius, packed.outline, packed.axis, space, packed.container_volume);
    if (!(s.volume > 0) || !std::isfinite(s.volume))
      return see("shape of the specimen", false, fmt::format("its volume is {} m3", s.volume),
                 "look at `outline` and `axis`");
    std::string fault;
    const auto volume = [&](double asked) {
      if (packed.container_volume > 0 && std::abs(packed.container_volume / asked - 1) > 1e-6)
        fault = fmt::format("`container_volume` is {:.5g} m3, that of the container {:.5g} m3", packed.container_volume,
                            asked);
    };
    if (const auto& c = case_->container) {
      const int dimension = case_->request.dimension;
      double asked = c->measure() * (dimension == 2 ? case_->request.thickness : 1);
      for (int k = 0; k < dimension; ++k) {
        if (packed.period[k] > 0) asked *= packed.period[k] / c->size()[k];
        const double size = c->size()[k], got = s.extent[k];
        if (packed.period[k] <= 0 && (got < size - 4.001 * m.most || got > size * (1 + 1e-6)) &&
            !(case_->choice.config.value("margin", 0.0) > 0))
          fault = fmt::format("along {} the particles reach over {:.4g} m of {:.4g} m", "xyz"[k], got, size);
      }
      volume(asked);
      if (packed.outline != c->outline()) fault = "`outline` is not that of the container";
      if (c->shape() == Container::Shape::cylinder && std::abs(packed.axis.dot(c->axis())) < 1 - 1e-9)
        fault = "`axis` is not that of the cylinder";
    }
    see("shape of the specimen", fault, fmt::format("{:.4g} m3 as measured", s.volume),
        "fill the container from end to end, and take `outline`, `axis` and the volume (in two dimensions the area "
        "times "
        "`thickness`) from it");
  }

  void radii(const PackedParticles& packed, const PackingMeasures& m) {
    const auto asked = asked_radii(case_->choice.config);
    if (!asked)
      return trials_.skip(
          "radii asked for", "",
          "it has no parameter `radius` (a length, or of the SDK's form) and no `radius_min` and `radius_max`");
    constexpr double share = 0.02;  // by which all may be scaled to meet a porosity
    std::string fault;
    if (m.least < asked->least * (1 - share) || m.most > asked->most * (1 + share))
      fault = fmt::format("from {:.4g} to {:.4g} m, where {:.4g} to {:.4g} m were asked for", m.least, m.most,
                          asked->least, asked->most);
    const double n = double(packed.radius.size());
    if (asked->mean && asked->deviation) {
      const double near = share * *asked->mean + 4 * *asked->deviation / std::sqrt(n);
      if (std::abs(m.mean - *asked->mean) > near)
        fault = fmt::format("their mean is {:.4g} m, where {:.4g} m was asked for", m.mean, *asked->mean);
      else if (std::abs(m.deviation - *asked->deviation) >
               share * *asked->mean + 4 * *asked->deviation / std::sqrt(2 * n))
        fault = fmt::format("their standard deviation is {:.4g} m, where {:.4g} m was asked for", m.deviation,
                            *asked->deviation);
    }
    see("radii asked for", fault, fmt::format("{:.4g} to {:.4g} m", m.least, m.most),
        "take them from the distribution (`quantile_radii`), and do not change them to make them fit");
  }

  void report(const PackedParticles& packed, const PackingMeasures& m) {
    std::string fault;
    std::vector<std::string> seen;
    for (const AskedGot& line : packed.report) {
      if (const std::string wrong = fault_of_name(line.name, line.unit); !wrong.empty())
        fault = "line `" + line.name + "`: " + wrong;
      else if (std::count(seen.begin(), seen.end(), line.name)) fault = "line `" + line.name + "` is there twice";
      else if (!std::isfinite(line.got) || (line.asked && !std::isfinite(*line.asked)))
        fault = "line `" + line.name + "` holds what is no number";
      seen.push_back(line.name);
      const auto is = measured_as(line.name, packed, m);
      if (is && std::abs(*is - line.got) > 1e-6 * std::abs(*is) + (line.unit == "1" ? 1e-9 : 0) &&
          !(line.name == "max_overlap" && *is <= line.got))
        fault = fmt::format("line `{}` says {:.6g} {}, measured {:.6g}", line.name, line.got, line.unit, *is);
      const Json& config = case_->choice.config;
      if (line.asked && config.contains(line.name) && config[line.name].is_number() &&
          std::abs(*line.asked - config[line.name].get<double>()) > 1e-9 * std::abs(*line.asked))
        fault = fmt::format("line `{}` says that {:.6g} was asked for, which is {:.6g}", line.name, *line.asked,
                            config[line.name].get<double>());
    }
    if (packed.report.empty()) return trials_.skip("report", "", "it reports nothing of what was asked and got");
    see("report", fault, fmt::format("{} lines", packed.report.size()),
        "measure what is reported from the particles that are returned");
  }

  void again(const PackedParticles& packed, const PackingMeasures& m) {
    const std::string different = "another packing";
    const auto other = [&](int threads, std::uint64_t seed) {
      PackingHost host(user_, threads);
      bool same = false;
      const Attempt end = attempt([&] { same = same_packing(packed, make(host, seed)); });
      return !end ? end.text : same ? "" : different;
    };
    see("the same twice", other(1, 1), "the same bits",
        "the same request must give the same bits: look for clocks, `std::random_device`, static variables and "
        "unordered containers");
    for (const int threads : {2, 3})
      see("threads", other(threads, 1), "the same bits for 1, 2 and 3",
          "the result depends on `Host::threads()`: sums must have an order that does not depend on how the work is "
          "split");
    const std::string seeded = other(1, 2);
    if (reads_) trials_.skip("another seed", "", "it reads its particles from a file");
    else if (seeded != different && !seeded.empty()) trials_.skip("another seed", case_->name, seeded);
    else if (!seeded.empty()) see("another seed", true, seeded, "");
    else
      see("another seed", m.orderly,
          m.orderly ? "an arrangement without chance: the same for any seed" : "the same packing",
          "`PackingRequest::seed` has no part in it: give it to the random numbers");
  }

  /// As two ranks of a job would make it.
  void in_shares(const PackedParticles& packed) {
    if (!registry_.create<Packing>(case_->choice)->makes_shares()) return;
    PackedParticles shares[2];
    TwoParts makers;
    std::string fault = attempt([&] {
                          makers.together([&](int number, OtherParts& others) {
                            PackingRequest request = case_->request;
                            request.share.part = {&others, {}, {}, {}, number, 2};
                            PackingHost host(user_);
                            shares[number] = registry_.create<Packing>(case_->choice)->generate(request, host);
                          });
                        }).text;
    if (fault.empty()) {
      if (!same_packing(packed, joined(shares[0], shares[1]))) fault = "joined they are another packing";
      for (const PackedParticles& share : shares)
        if (!same_report(packed, share)) fault = "a share has another report, outline, axis, volume or period";
    }
    see("in two shares", fault, "the same bits",
        "it says that ranks may make it in shares (`makes_shares`): make what `PackingRequest::share_of` gives, in the "
        "same order, and put together what is measured by `share.sum`, `share.max` or `share.all`");
  }

  /// A packing that is stopped before it begins. One that has not asked may do so where there is more to do.
  void cancelled(double seconds, std::size_t particles) {
    constexpr const char* check = "cancellation";
    const double each = seconds / double(particles);
    constexpr double slow = 20e-6;  // a million of them would take 20 s
    const PackingCase* const given = case_;
    PackingHost host(user_, 1, -1);
    Attempt end = attempt([&] { make(host); });
    double allowed = 0.5 * seconds + 0.2, took = host.seconds();
    if (const auto more = enlarged(*given, 3); host.asked == 0 && each > slow && more) {
      case_ = &*more;
      const double from = host.seconds();
      end = attempt([&] { make(host); });
      took = host.seconds() - from;
      allowed += 0.5 * seconds * (given->request.dimension == 2 ? 9 : 27);
      case_ = given;
    }
    if (end.end == Attempt::End::cancelled)
      see(check, took <= allowed, fmt::format("stops after {:.2g} s", took), "ask `Host::cancelled()` more often");
    else if (end.end != Attempt::End::whole) see(check, false, end.text, "throw `Cancelled` when the user stops it");
    else if (host.asked > 0) see(check, false, "it asks `Host::cancelled()`, and goes on", "throw `Cancelled` then");
    else if (each > slow)
      see(check, false, fmt::format("it never asks, and takes {:.2g} s a million particles", 1e6 * each),
          "ask `Host::cancelled()` now and then, and throw `Cancelled`");
    else trials_.skip(check, "", "it never asks, and is quick");
  }

  /// Whatever the ranges of the parameters allow gives a packing, or is refused in words.
  void ranges() {
    if (ranged_[case_->request.dimension - 2]++ > 0) return;  // once in each dimension
    std::mt19937_64 random(17);
    const ParamSpec& root = registry_.documentation(Packing::kind, name_).root;
    const PackingCase* const given = case_;
    int tried = 0;
    std::string fault;
    for (int draw = 0; draw < 8 && fault.empty(); ++draw) {
      PackingCase drawn = *given;
      drawn.choice.config = drawn_config(root, given->choice.config, random, 0.25, false);
      case_ = &drawn;
      PackedParticles packed;
      const Attempt end = attempt([&] {
        if (!registry_.check(Packing::kind, name_, drawn.choice.config).empty()) throw UserError("its own rules");
        PackingHost host(user_, 1, 0.15);
        packed = make(host);
      });
      if (end.end == Attempt::End::fault) fault = end.text + ", with " + drawn.choice.config.dump();
      if (end) fault = fault_of_numbers(packed);
      if (end && !fault.empty()) fault += ", with " + drawn.choice.config.dump();
      tried += bool(end);
    }
    case_ = given;
    see("numbers for all that the ranges allow", fault, fmt::format("8 draws of the parameters, {} of them met", tried),
        "narrow a range, say in `check` or by a UserError what does not go together, or mind the division by zero");
  }

  const Registry& registry_;
  std::string name_;
  TemporaryFolder folder_;
  std::vector<PackingWays> cases_;
  std::vector<std::pair<std::string, std::string>> refused_;
  const PackingCase* case_ = nullptr;
  const Host& user_;
  Trials trials_;
  bool reads_ = false;
  int ranged_[2] = {0, 0};
};

}  // namespace

CheckFindings check_packing(const Registry& registry, const std::string& name,
                            const std::vector<std::string>& parameters, const Host& user) {
  return PackingCheck(registry, name, parameters, user)();
}

}  // namespace breccia
