// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "archive/memory_archive.hpp"
#include "check/attempt.hpp"
#include "check/check.hpp"
#include "check/example.hpp"
#include "check/made_parts.hpp"
#include "check/made_specimen.hpp"
#include "check/postprocessor_run.hpp"

namespace breccia {
namespace {

constexpr double frames_time = 1e-5;  // between two states [s]
constexpr const char* numbers = "finite numbers";
constexpr const char* numbers_mend =
    "look for sums over nothing, divisions by a count of zero, and columns that `sample` does not set in every row";

/// What a strain of this name must be; none where the name is not of the usual ones.
std::optional<double> expected_strain(const std::string& name, const Mat3& strain, const Vec3& axis, int dimension) {
  const auto has = [&](const char* part) { return name.find(part) != std::string::npos; };
  const double along = axis.dot(strain * axis);
  if (has("axial_strain")) return -along;
  if (has("lateral_strain")) return (strain.trace() - along) / (dimension - 1);
  if (has("volumetric_strain")) return -strain.trace();
  constexpr std::string_view axes = "xyz";
  if (const auto at = name.rfind("strain_"); at != std::string::npos && name.size() == at + 9) {
    const auto a = axes.find(name[at + 7]), b = axes.find(name[at + 8]);
    if (a != axes.npos && b != axes.npos) return strain(Eigen::Index(a), Eigen::Index(b));
  }
  return {};
}

class PostprocessorCheck {
 public:
  PostprocessorCheck(const Registry& registry, PluginChoice choice, const Host& user)
      : registry_(registry), choice_(std::move(choice)), trials_(user) {}

  CheckFindings operator()() {
    for (const MadeForm& form : made_forms())
      for (const bool disorder : {false, true}) {
        if (form.periodic && !disorder) continue;
        where_ = form.name + (disorder ? "" : ", lattice");
        first_ = made_simulation(made_packing(form, disorder), form.dimension);
        disorder_ = disorder;
        const Attempt begun = attempt([&] { PostprocessorRun(registry_, choice_, first_); });
        if (begun.end == Attempt::End::refused) {
          trials_.skip("measures", where_, begun.text);
          continue;
        }
        guarded([&] { whole(); });
        guarded([&] { strains(); });
        guarded([&] { repeated(); });
        guarded([&] { order(); });
        guarded([&] { resumed(); });
        guarded([&] { in_parts(); });
        if (disorder) edges(form);
      }
    if (!trials_.any())
      trials_.see("measures", "every specimen", false, "nothing could be tried",
                  "give the parameters that it needs by `--set`");
    return trials_.findings();
  }

 private:
  template <class F>
  void guarded(F&& f) {
    const Attempt end = attempt(f);
    trials_.see(
        "measures", where_, bool(end), end.text,
        "what a plugin throws while it measures ends a run: only `begin` should refuse a specimen, by a UserError");
  }

  Mat3 gradient(double size) const {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> u(-1, 1);
    Mat3 g = Mat3::Zero();
    for (int a = 0; a < first_.dimension; ++a)
      for (int b = 0; b < first_.dimension; ++b) g(a, b) = size * u(random);
    return g;
  }
  Mat3 rotation(double angle) const {
    const Vec3 about = first_.dimension == 2 ? Vec3(0, 0, 1) : Vec3(0.6, -0.48, 0.64);
    Mat3 g;
    g << 0, -about.z(), about.y(), about.z(), 0, -about.x(), -about.y(), about.x(), 0;
    return angle * g;
  }
  /// From rest along a displacement that grows, and at the end, if it `returns`, is taken back; from the third on some
  /// bonds, or all, are broken.
  States along(const Mat3& full, std::size_t break_every = 0, bool returns = false) const {
    States states;
    MadeSimulation s = first_;
    const Vec3 shift = made_radius * (first_.dimension == 2 ? Vec3(0.3, -0.2, 0) : Vec3(0.3, -0.2, 0.1));
    constexpr int steps = 4;
    for (int k = 0; k <= steps; ++k) {
      const double share = returns && 2 * k > steps ? 1.5 - double(k) / steps : double(k) / steps * (returns ? 2 : 1);
      if (break_every > 0 && k >= 2)
        for (std::size_t b = std::size_t(k); b < s.bond_i.size(); b += break_every)
          if (s.bond_state[b] == BondState::intact)
            s.break_bond(b, b % 2 ? BondState::broken_shear : BondState::broken_tension);
      displace(s, share * full, share * shift, k * frames_time);
      states.push_back(s);
    }
    return states;
  }
  PostprocessorRun run(const States& states, int threads = 1) const {
    PostprocessorRun r(registry_, choice_, states.front(), threads);
    r.whole(states);
    return r;
  }

  void whole() {
    const States states = along(gradient(1e-3));
    const PostprocessorRun a = run(states);
    const std::string name = fault_of_names(a), value = fault_of_values(a, states);
    trials_.see("names and units", where_, name.empty(), name.empty() ? "in order" : name,
                "look at what `begin`, `fields` and `finish` call their results");
    trials_.see(numbers, where_, value.empty(), value.empty() ? "in every row, field and result" : value, numbers_mend);
    const std::string again = difference(a, run(states));
    trials_.see("the same twice", where_, again.empty(), again.empty() ? "the same bits" : again,
                "something is not set when a plugin is made, or is shared by two of them (a static variable)");
    for (const int threads : {2, 3}) {
      const std::string other = difference(a, run(states, threads));
      trials_.see("threads", where_, other.empty(), other.empty() ? "the same bits for 1, 2 and 3" : other,
                  "sums must have an order that does not depend on how the work is split");
    }
  }

  /// An affine displacement has one strain, which is known; a rigid motion has none.
  void strains() {
    if (first_.cell.repeats()) return;
    constexpr double size = 1e-6;  // second order in it is rounding
    for (const bool rigid : {true, false}) {
      const Mat3 full = rigid ? rotation(size) : gradient(size);
      const Mat3 strain = 0.5 * (full + full.transpose());
      const PostprocessorRun r = run(along(full));
      // Where groups of particles stand for sections, their mean places are not quite opposite each other.
      const double allowed = (disorder_ ? 0.25 : 1e-4) * size;
      const auto compare = [&](const std::string& name, double value) {
        const std::optional<double> expected =
            rigid ? 0 : expected_strain(name, strain, first_.specimen.axis, first_.dimension);
        if (!expected)
          return trials_.skip("strain of an affine displacement", "",
                              "`" + name + "`: what it is of the strain is not known by its name");
        const double off = std::abs(value - *expected);
        trials_.see(
            rigid ? "no strain in a rigid motion" : "strain of an affine displacement", where_, off <= allowed,
            fmt::format("`{}` is {:.4g}, known to be {:.4g}", name, value, *expected),
            rigid
                ? "a rotation is taken for a strain: only the symmetric part of the displacement gradient is one, and "
                  "the "
                  "displacements are from the places at the start of loading"
                : "look at the components, signs (`axial_strain` and `volumetric_strain` are positive in compression, "
                  "`lateral_strain` in extension), and at the volume over which it is averaged",
            off);
      };
      const auto is_strain = [](const std::string& name, const std::string& unit) {
        return unit == "1" && name.find("strain") != std::string::npos;
      };
      bool any = false;
      for (std::size_t c = 0; c < r.own_columns; ++c)
        if (const Column& column = r.rows.columns()[c]; is_strain(column.name, column.unit)) {
          compare(column.name, r.rows.values(c).back());
          any = true;
        }
      for (const Field& f : r.fields.back())
        if (is_strain(f.name, f.unit) && f.components == 1 && f.on == Field::On::particles) {
          any = true;
          // That of the particle which is farthest off.
          const double known =
              rigid
                  ? 0
                  : expected_strain(f.name, strain, first_.specimen.axis, first_.dimension).value_or(f.values.front());
          compare(f.name, *std::max_element(f.values.begin(), f.values.end(), [&](double a, double b) {
                    return std::abs(a - known) < std::abs(b - known);
                  }));
        }
      if (!any)
        trials_.skip("strain of an affine displacement", "", "no curve or field without unit has `strain` in its name");
    }
  }

  /// How often a state is looked at is no part of it.
  void repeated() {
    const States states = along(gradient(1e-3), 5);
    PostprocessorRun once(registry_, choice_, states.front()), often(registry_, choice_, states.front());
    for (PostprocessorRun* r : {&once, &often}) {
      r->start(states.front());
      for (const MadeSimulation& s : states) r->sample(s, r == &often ? 3 : 1);
    }
    const std::string other = difference(once, often);
    trials_.see("sampled once or three times", where_, other.empty(),
                other.empty() ? "the same rows and fields" : other,
                "a row depends on how many were measured before it: measure the state that is shown, or keep its time");
  }

  void order() {
    if (!disorder_) return;  // where particles are as near as others, their order may decide
    const States states = along(gradient(1e-3), 7);
    std::vector<Index> other(first_.radius.size());
    std::iota(other.begin(), other.end(), Index(0));
    std::shuffle(other.begin(), other.end(), std::mt19937_64(9));
    States mixed;
    for (const MadeSimulation& s : states) mixed.push_back(reordered(s, other));
    const std::string off = difference(run(states), run(mixed), &other);
    trials_.see("order of the particles", where_, off.empty(), off.empty() ? "the same to rounding" : off,
                "particles and pairs may stand in any order, and each pair has either end first: forces are on i, "
                "their opposites on j");
  }

  /// As a run that is stopped in its middle and goes on.
  void resumed() {
    const States states = along(gradient(1e-3), 5, true);
    const PostprocessorRun all = run(states);
    PostprocessorRun before(registry_, choice_, states.front());
    before.start(states.front());
    for (std::size_t at = 1; at < states.size(); ++at) {
      before.sample(states[at - 1]);
      MemoryArchive archive;
      if (!before.archive(archive))
        return trials_.skip("archive and resume", "",
                            "`archive` returns false: runs with this plugin have no checkpoints");
      archive.read_back();
      PostprocessorRun after(registry_, choice_, states.front());
      after.rows = before.rows;
      after.archive(archive);
      for (std::size_t k = at; k < states.size(); ++k) after.sample(states[k]);
      after.finish(states.back());
      const std::string off = difference(all, after);
      trials_.see("archive and resume", where_, off.empty(), off.empty() ? "the same bits from each state on" : off,
                  "`archive` misses a member that changes after `begin`");
    }
  }

  /// As two ranks of a job would measure it, each its half of the particles.
  void in_parts() {
    States states, of_half[2];
    for (const MadeSimulation& s : along(gradient(1e-3), 5, true)) {
      states.push_back(sorted(s));
      const auto both = halves(states.back());
      for (std::size_t h = 0; h < 2; ++h) of_half[h].push_back(both[h]);
    }
    const PostprocessorRun all = run(states);
    if (!all.sees_parts()) return;
    std::optional<PostprocessorRun> half[2];
    TwoParts parts;
    const Attempt end = attempt([&] {
      parts.together([&](int number, OtherParts& others) {
        States& mine = of_half[number];
        for (MadeSimulation& s : mine) s.part->others = &others;
        half[number].emplace(registry_, choice_, mine.front());
        half[number]->whole(mine);
      });
    });
    std::string off = end.text;
    if (end) {
      half[0]->fields = joined_fields(*half[0], of_half[0], *half[1], of_half[1]);
      off = difference(all, *half[0]);
    }
    trials_.see(
        "in two parts", where_, off.empty(), off.empty() ? "the same bits" : off,
        "it says that it sees parts (`sees_parts`): loop over `own_particles`, `own_pairs` and `own_bonds`, and "
        "put together by `view.sum`, `view.max` or `view.all`");
  }

  void edges(const MadeForm& form) {
    PackedParticles one = made_packing(form, false);
    one.position.resize(1);
    one.radius.resize(1);
    const MadeSimulation whole = first_;
    const auto tried = [&](const char* what, const MadeSimulation& first, std::size_t break_every) {
      first_ = first;
      const std::string where = form.name + ", " + what;
      std::string fault;
      const Attempt end = attempt([&] {
        const States states = along(gradient(1e-3), break_every);
        fault = fault_of_values(run(states), states);
      });
      if (end.end == Attempt::End::refused) trials_.skip(numbers, where, end.text);
      else trials_.see(numbers, where, end && fault.empty(), end ? fault : end.text, numbers_mend);
    };
    tried("without bonds", without_pairs(whole), 0);
    tried("all bonds broken", whole, 1);
    tried("one particle", made_simulation(one, form.dimension), 0);
    first_ = whole;
  }

  const Registry& registry_;
  PluginChoice choice_;
  Trials trials_;
  MadeSimulation first_;
  std::string where_;
  bool disorder_ = false;
};

}  // namespace

CheckFindings check_postprocessor(const Registry& registry, const std::string& name,
                                  const std::vector<std::string>& parameters, const Host& user) {
  return PostprocessorCheck(registry, example_plugin(registry, Postprocessor::kind, name, parameters), user)();
}

}  // namespace breccia
