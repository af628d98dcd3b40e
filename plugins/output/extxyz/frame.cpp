// SPDX-License-Identifier: BSD-3-Clause
#include "frame.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <numeric>

#include "../../shared/checked_field.hpp"

namespace breccia::extxyz {
namespace {

template <class Number>
void add_number(std::string& line, Number value) {
  char text[32];
  line.append(text, std::to_chars(text, text + sizeof text, value).ptr);
}

std::string text_of(const Vec3& v) {
  std::string text;
  for (int c = 0; c < 3; ++c) {
    if (c) text += ' ';
    add_number(text, v[c]);
  }
  return text;
}

struct Property {
  std::string name;
  char type;  ///< of the format: R, I, S
  int count;
  std::string unit;
  std::function<void(std::string& line, std::size_t particle)> add;  ///< its columns, a space before each
};

class Properties {
 public:
  explicit Properties(Precision precision) : precision_(precision) {}

  void add(Property property) {
    const auto same = [&](const Property& p) { return p.name == property.name; };
    if (std::any_of(all_.begin(), all_.end(), same)) refuse_second_field(property.name, "extxyz");
    all_.push_back(std::move(property));
  }
  /// `get(particle)` gives a number or a vector. `exact`: in 64 bits, whatever the precision.
  template <class Get>
  void real(std::string name, std::string unit, Get get, bool exact = false) {
    constexpr int count = std::is_convertible_v<decltype(get(0)), Vec3> ? 3 : 1;
    const bool in_64_bits = exact || precision_ == Precision::double_precision;
    add({std::move(name), 'R', count, std::move(unit), [get, in_64_bits](std::string& line, std::size_t p) {
           if constexpr (count == 3) {
             const Vec3 v = get(p);
             for (int c = 0; c < 3; ++c) add_real(line, v[c], in_64_bits);
           } else {
             add_real(line, get(p), in_64_bits);
           }
         }});
  }
  void field(const Field& f) {
    const int n = f.components;
    // OVITO has the components of a symmetric tensor in another order than VTK: xx yy zz xy xz yz.
    static constexpr int of_tensor[6] = {0, 1, 2, 3, 5, 4};
    const bool in_64_bits = precision_ == Precision::double_precision;
    add({f.name, f.whole ? 'I' : 'R', n, f.unit, [&f, n, in_64_bits](std::string& line, std::size_t p) {
           const double* const v = f.values.data() + p * std::size_t(n);
           for (int c = 0; c < n; ++c) {
             const double x = v[n == 6 ? of_tensor[c] : c];
             if (!f.whole) add_real(line, x, in_64_bits);
             else add_number(line += ' ', std::int64_t(x));
           }
         }});
  }
  const std::vector<Property>& all() const { return all_; }

 private:
  static void add_real(std::string& line, double x, bool in_64_bits) {
    line += ' ';
    if (in_64_bits) add_number(line, x);
    else add_number(line, float(x));
  }
  Precision precision_;
  std::vector<Property> all_;
};

Properties properties_of(const SimulationView& view, std::span<const Field> fields, Precision precision) {
  const ParticlesView& p = view.particles;
  Properties all(precision);
  all.add({"id", 'I', 1, "", [&p](std::string& line, std::size_t k) { add_number(line += ' ', p.id[k]); }});
  // Not `species`: a chemical element is expected there, and OVITO takes `type` as well.
  if (!p.material.empty())
    all.add({"type", 'S', 1, "",
             [&](std::string& line, std::size_t k) { line.append(" ").append(view.materials[p.material[k]]); }});
  const bool exact = true;
  all.real(
      "pos", "m", [&p](std::size_t k) { return p.position[k]; }, exact);
  all.real(
      "radius", "m", [&p](std::size_t k) { return p.radius[k]; }, exact);
  all.real("mass", "kg", [&p](std::size_t k) { return p.mass[k]; });
  all.real("disp", "m", [&p](std::size_t k) -> Vec3 { return p.position[k] - p.initial_position[k]; });
  all.real("velo", "m/s", [&p](std::size_t k) { return p.velocity[k]; });
  all.real("omega", "rad/s", [&p](std::size_t k) { return p.angular_velocity[k]; });
  all.real("force", "N", [&p](std::size_t k) { return p.force[k]; });
  for (const Field& f : fields) {
    if (f.on != Field::On::particles) continue;
    check_field(f, p.size(), "extxyz");
    all.field(f);
  }
  return all;
}

/// The cell where space repeats itself, else what holds the particles; about their middle, since positions may leave
/// the cell that they began in.
std::string box_text(const SimulationView& view) {
  const ParticlesView& p = view.particles;
  if (p.size() == 0) return {};
  Vec3 low = p.position[0], high = p.position[0];
  for (std::size_t k = 0; k < p.size(); ++k) {
    low = low.cwiseMin(p.position[k] - Vec3::Constant(p.radius[k]));
    high = high.cwiseMax(p.position[k] + Vec3::Constant(p.radius[k]));
  }
  Mat3 box = view.cell.vectors();
  std::string repeats;
  for (int k = 0; k < 3; ++k) {
    if (!view.cell.repeats(k)) box.col(k) = (high - low)[k] * Vec3::Unit(k);
    repeats += std::string(k ? " " : "") + (view.cell.repeats(k) ? "T" : "F");
  }
  const Vec3 a = box.col(0), b = box.col(1), c = box.col(2), origin = 0.5 * (low + high) - 0.5 * (a + b + c);
  return "Lattice=\"" + text_of(a) + " " + text_of(b) + " " + text_of(c) + "\" Origin=\"" + text_of(origin) +
         "\" pbc=\"" + repeats + "\" ";
}

}  // namespace

std::string frame_text(const SimulationView& view, std::span<const Field> fields, Precision precision) {
  const std::size_t n = view.particles.size();
  const Properties properties = properties_of(view, fields, precision);
  std::string text = std::to_string(n) + "\n" + box_text(view) + "Properties=", units;
  for (const Property& p : properties.all()) {
    text += (&p == &properties.all().front() ? "" : ":") + p.name + ":" + p.type + ":" + std::to_string(p.count);
    if (!p.unit.empty() && p.unit != "1") units += (units.empty() ? "" : "; ") + p.name + " in " + p.unit;
  }
  text += " Time=";
  add_number(text, view.time);
  text += " dimension=" + std::to_string(view.dimension) + " units=\"" + units + "; Time in s\"\n";

  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return view.particles.id[a] < view.particles.id[b]; });
  std::string line;
  for (const std::size_t particle : order) {
    line.clear();
    for (const Property& p : properties.all()) p.add(line, particle);
    text.append(line, 1, line.npos).append("\n");  // without the space before the first
  }
  return text;
}

}  // namespace breccia::extxyz
