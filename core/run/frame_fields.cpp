// SPDX-License-Identifier: BSD-3-Clause
#include "run/frame_fields.hpp"

#include <algorithm>

#include "engine/migration.hpp"
#include "run/run_ranks.hpp"

namespace breccia {
namespace {

OwnRows own_rows(const SimulationView& part, Field::On on) {
  return on == Field::On::particles ? part.own_particles() : part.own_bonds();
}

std::size_t all_rows(const SimulationView& view, Field::On on) {
  return on == Field::On::particles ? view.particles.size() : view.bonds.size();
}

/// Its values in order, as whoever writes it would find them, too; said here, as lengths are sent to other ranks.
void check_lengths(const std::vector<Field>& fields, const SimulationView& view) {
  for (const Field& f : fields)
    if (f.components < 1 || f.values.size() != all_rows(view, f.on) * std::size_t(f.components))
      throw UserError("the field `" + f.name + "` has " + std::to_string(f.values.size()) + " values, where " +
                      std::to_string(all_rows(view, f.on)) + " times " + std::to_string(f.components) + " belong");
}

void append(std::vector<Field>& to, std::vector<Field> fields, const std::string& prefix) {
  for (Field& f : fields) {
    f.name = prefix + f.name;
    to.push_back(std::move(f));
  }
}

}  // namespace

/// As it sees the step: parts, or the whole on the first rank.
const std::vector<Field>& FrameFields::given_by(std::size_t k) {
  if (!given_[k]) {
    given_[k].emplace();
    auto& p = postprocessors_[k];
    if (!p.has_failed())
      p.show(views_, "giving fields",
             [&](Postprocessor& q, const SimulationView& view) { q.fields(view, *given_[k]); });
  }
  return *given_[k];
}

const std::vector<Field>& FrameFields::of_part() {
  if (part_) return *part_;
  part_.emplace();
  for (std::size_t k = 0; k < postprocessors_.size(); ++k) {
    const auto& p = postprocessors_[k];
    const std::vector<Field>& given = given_by(k);
    append(*part_, p.sees_parts() ? given : dealt(given), p.prefix());
  }
  return *part_;
}

const std::vector<Field>& FrameFields::of_whole() {
  if (whole_) return *whole_;
  whole_.emplace();
  for (std::size_t k = 0; k < postprocessors_.size(); ++k) {
    const auto& p = postprocessors_[k];
    const std::vector<Field>& given = given_by(k);
    append(*whole_, p.sees_parts() ? gathered(given) : given, p.prefix());
  }
  return *whole_;
}

std::vector<Field> FrameFields::gathered(const std::vector<Field>& of_parts) {
  RankLink* const link = views_.others().link();
  const SimulationView& part = views_.part();
  if (!link || !part.part) return of_parts;
  views_.others().together([&] {
    check_lengths(of_parts, part);
    // What is sent must be asked for: the same fields everywhere.
    std::vector<double> kinds{double(of_parts.size()), -double(of_parts.size())};
    part.max(kinds);
    if (kinds[0] != -kinds[1]) throw UserError("a post-processor has given other fields on other ranks");
    kinds.clear();
    for (const Field& f : of_parts)
      for (const double kind : {double(f.components), double(f.on == Field::On::bonds)}) {
        kinds.push_back(kind);
        kinds.push_back(-kind);
      }
    part.max(kinds);
    for (std::size_t k = 0; k < kinds.size(); k += 2)
      if (kinds[k] != -kinds[k + 1]) throw UserError("a post-processor has given other fields on other ranks");
  });
  std::vector<Field> whole;
  for (const Field& f : of_parts) {
    const OwnRows own = own_rows(part, f.on);
    const std::vector<std::size_t> counts = link->numbers_of_all(own.size());
    std::size_t total = 0;
    for (const std::size_t c : counts) total += c;
    const std::size_t n = std::size_t(f.components);
    Field all{f.on, f.name, f.unit, f.components, {}, f.whole};
    if (link->first()) all.values.resize(total * n);
    if (total) link->gather(f.values.data() + own.first() * n, counts, n * sizeof(double), all.values.data(), false);
    whole.push_back(std::move(all));
  }
  return whole;
}

std::vector<Field> FrameFields::dealt(const std::vector<Field>& of_whole) {
  RankLink* const link = views_.others().link();
  const SimulationView& part = views_.part();
  if (!link || !part.part) return of_whole;
  const SimulationView& whole = views_.whole();
  views_.others().together([&] {
    if (link->first()) check_lengths(of_whole, whole);
  });
  // The first tells what there is, then each its own rows.
  const RunRanks ranks(link);
  Json heads = Json::array();
  for (const Field& f : of_whole) heads.push_back({int(f.on), f.name, f.unit, f.components, f.whole});
  heads = Json::parse(ranks.told(heads.dump()));
  std::vector<Field> mine;
  for (std::size_t k = 0; k < heads.size(); ++k) {
    const Json& h = heads[k];
    Field f{h[0].get<int>() == 0 ? Field::On::particles : Field::On::bonds, h[1], h[2], h[3], {}, h[4]};
    const OwnRows own = own_rows(part, f.on);
    const std::size_t n = std::size_t(f.components);
    const std::vector<std::size_t> counts = link->numbers_of_all(own.size());
    std::vector<std::vector<double>> to(counts.size());
    if (link->first()) {
      auto at = of_whole[k].values.begin();
      for (std::size_t r = 0; r < counts.size(); ++r) {
        to[r].assign(at, at + std::ptrdiff_t(counts[r] * n));
        at += std::ptrdiff_t(counts[r] * n);
      }
    }
    const std::vector<double> from = sent(*link, to);
    f.values.assign(all_rows(part, f.on) * n, 0.0);
    std::copy(from.begin(), from.end(), f.values.begin() + std::ptrdiff_t(own.first() * n));
    mine.push_back(std::move(f));
  }
  return mine;
}

}  // namespace breccia
