// SPDX-License-Identifier: BSD-3-Clause
// Files of the extended XYZ format, read by what the format says: a count, a line of keys, columns as `Properties`
// lists them.
#include <zlib.h>

#include <map>
#include <sstream>

#include "breccia/output.hpp"
#include "plugin_under_test.hpp"
#include "specimen.hpp"

namespace breccia::test {
namespace {
namespace fs = std::filesystem;

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

struct Frame {
  std::map<std::string, std::string> keys;
  std::map<std::string, char> type;
  std::map<std::string, std::vector<std::vector<std::string>>> rows;  ///< of each property

  explicit Frame(const std::string& text) {
    std::istringstream in(text);
    std::string line;
    std::getline(in, line);
    const std::size_t count = std::stoul(line);
    std::getline(in, line);
    for (std::size_t at = 0; at < line.size();) {
      const std::size_t equals = line.find('=', at);
      const bool quoted = line[equals + 1] == '"';
      const std::size_t first = equals + 1 + quoted, end = std::min(line.find(quoted ? '"' : ' ', first), line.size());
      keys[line.substr(at, equals - at)] = line.substr(first, end - first);
      at = end + 1 + quoted;
    }
    std::vector<std::pair<std::string, int>> columns;
    std::istringstream properties(keys.at("Properties"));
    for (std::string name, kind, n; std::getline(properties, name, ':');) {
      std::getline(properties, kind, ':');
      std::getline(properties, n, ':');
      columns.emplace_back(name, std::stoi(n));
      type[name] = kind.at(0);
    }
    for (std::size_t k = 0; k < count; ++k) {
      EXPECT_TRUE(std::getline(in, line));
      std::istringstream row(line);
      for (const auto& [name, n] : columns) {
        rows[name].emplace_back();
        for (int c = 0; c < n; ++c) {
          std::string word;
          EXPECT_TRUE(row >> word) << name;
          rows[name].back().push_back(word);
        }
      }
      std::string more;
      EXPECT_FALSE(row >> more) << "more columns than Properties has";
    }
    EXPECT_FALSE(std::getline(in, line)) << "more lines than particles";
  }

  double number(const std::string& name, std::size_t row, std::size_t column = 0) const {
    return std::stod(rows.at(name).at(row).at(column));
  }
  Vec3 vector(const std::string& name, std::size_t row) const {
    return {number(name, row, 0), number(name, row, 1), number(name, row, 2)};
  }
  std::vector<double> numbers(const std::string& key) const {
    std::istringstream in(keys.at(key));
    return {std::istream_iterator<double>(in), {}};
  }
};

class Extxyz : public ::testing::Test {
 protected:
  std::unique_ptr<Output> begin(const Json& config = {}) {
    auto output = make<Output>(BRECCIA_EXTXYZ_PLUGIN, config);
    output->begin(folder_.path(), host_);
    return output;
  }
  Frame written(const SimulationView& view, std::span<const Field> fields = {}) {
    begin({{"precision", "double"}})->frame(view, fields);
    return Frame(bytes_of(folder_.path() / "particles_000000.xyz"));
  }
  Folder folder_;
  QuietHost host_;
  inline static const Specimen specimen_{300, 3};
};

TEST_F(Extxyz, ParticlesComeBackAsTheyWereInTheOrderOfThePacking) {
  const SimulationView view = specimen_.view(2.5e-3);
  const ParticlesView& p = view.particles;
  const Frame f = written(view, specimen_.fields());
  for (std::size_t k = 0; k < p.size(); ++k) {
    const std::size_t row = p.id[k];  // ids of the specimen are 0 to n - 1
    ASSERT_EQ(f.number("id", row), double(p.id[k]));
    EXPECT_EQ(f.vector("pos", row), p.position[k]);
    EXPECT_EQ(f.number("radius", row), p.radius[k]);
    EXPECT_EQ(f.number("mass", row), p.mass[k]);
    EXPECT_EQ(f.vector("disp", row), p.position[k] - p.initial_position[k]);
    EXPECT_EQ(f.vector("velo", row), p.velocity[k]);
    EXPECT_EQ(f.vector("omega", row), p.angular_velocity[k]);
    EXPECT_EQ(f.vector("force", row), p.force[k]);
    EXPECT_EQ(f.number("damage", row), specimen_.fields()[0].values[k]);
  }
  EXPECT_EQ(std::stod(f.keys.at("Time")), 2.5e-3);
  EXPECT_FALSE(f.rows.contains("length_change")) << "a field of the bonds";
  EXPECT_FALSE(f.rows.contains("type")) << "there is one material";
  EXPECT_NE(f.keys.at("units").find("velo in m/s"), std::string::npos);
}

TEST_F(Extxyz, SinglePrecisionRoundsFieldsOnly) {
  const SimulationView view = specimen_.view(0);
  begin()->frame(view, {});
  const Frame f(bytes_of(folder_.path() / "particles_000000.xyz"));
  for (const std::size_t k : {std::size_t(0), std::size_t(7)}) {
    const std::size_t row = view.particles.id[k];
    EXPECT_EQ(f.vector("pos", row), view.particles.position[k]);
    EXPECT_EQ(float(f.number("velo", row)), float(view.particles.velocity[k].x()));
    EXPECT_LE(f.rows.at("velo").at(row).at(0).size(), 16u) << "no digits that mean nothing";
  }
}

/// Without a cell the box is what holds the particles, and nothing repeats itself.
TEST_F(Extxyz, TheBoxHoldsTheParticles) {
  const SimulationView view = specimen_.view(0);
  const Frame f = written(view);
  EXPECT_EQ(f.keys.at("pbc"), "F F F");
  const auto lattice = f.numbers("Lattice"), origin = f.numbers("Origin");
  ASSERT_EQ(lattice.size(), 9u);
  ASSERT_EQ(origin.size(), 3u);
  for (int c = 0; c < 3; ++c) {
    double low = 1e9, high = -1e9;
    for (std::size_t k = 0; k < view.particles.size(); ++k) {
      low = std::min(low, view.particles.position[k][c] - view.particles.radius[k]);
      high = std::max(high, view.particles.position[k][c] + view.particles.radius[k]);
    }
    EXPECT_NEAR(origin[std::size_t(c)], low, 1e-15);
    EXPECT_NEAR(lattice[std::size_t(4 * c)], high - low, 1e-15);
  }
}

/// A sheared cell that repeats itself along two of its vectors: in the file a vector is three numbers in a row.
TEST_F(Extxyz, WhereSpaceRepeatsItselfTheBoxIsTheCell) {
  SimulationView view = specimen_.view(0);
  Mat3 vectors;
  vectors << 0.03, 0.004, 0, 0, 0.05, 0, 0.001, 0, 0;
  view.cell = Cell(vectors);
  const Frame f = written(view);
  EXPECT_EQ(f.keys.at("pbc"), "T T F");
  const auto lattice = f.numbers("Lattice");
  for (std::size_t k = 0; k < 2; ++k)
    for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(lattice[3 * k + c], vectors(int(c), int(k)));
  EXPECT_EQ(lattice[6], 0);
  EXPECT_EQ(lattice[7], 0);
  EXPECT_GT(lattice[8], 0);
}

TEST_F(Extxyz, FieldsHaveTheirTypesAndTensorsTheOrderOfOvito) {
  const SimulationView view = specimen_.view(0);
  const std::size_t n = view.particles.size();
  std::vector<double> fragment(n), tensor(6 * n);
  for (std::size_t k = 0; k < n; ++k) {
    fragment[k] = double(k % 5);
    for (std::size_t c = 0; c < 6; ++c) tensor[6 * k + c] = double(10 * k + c);
  }
  const Field fields[] = {{Field::On::particles, "fragment_id", "1", 1, fragment, true},
                          {Field::On::particles, "stress", "Pa", 6, tensor}};
  const Frame f = written(view, fields);
  EXPECT_EQ(f.type.at("fragment_id"), 'I');
  EXPECT_EQ(f.type.at("stress"), 'R');
  const double order[6] = {0, 1, 2, 3, 5, 4};  // xx yy zz xy yz xz become xx yy zz xy xz yz
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t row = view.particles.id[k];
    EXPECT_EQ(f.rows.at("fragment_id").at(row).at(0), std::to_string(k % 5));
    for (std::size_t c = 0; c < 6; ++c) EXPECT_EQ(f.number("stress", row, c), double(10 * k) + order[c]);
  }
  const Field taken{Field::On::particles, "velo", "m/s", 1, std::vector<double>(n, 0)},
      shorter{Field::On::particles, "heat", "J", 1, {1}};
  EXPECT_NE(user_error([&] { written(view, {&taken, 1}); }).find("two fields are named `velo`"), std::string::npos);
  EXPECT_NE(user_error([&] { written(view, {&shorter, 1}); }).find("field `heat` has 1 values"), std::string::npos);
}

TEST_F(Extxyz, TypesAreTheNamesOfTheMaterials) {
  SimulationView view = specimen_.view(0);
  const std::vector<std::string> names = {"quartz", "mica"};
  std::vector<std::uint8_t> material(view.particles.size());
  for (std::size_t k = 0; k < material.size(); ++k) material[k] = k % 3 == 0;
  view.materials = names;
  view.particles.material = material;
  const Frame f = written(view);
  EXPECT_EQ(f.type.at("type"), 'S');
  for (std::size_t k = 0; k < material.size(); ++k)
    EXPECT_EQ(f.rows.at("type").at(view.particles.id[k]).at(0), names[material[k]]);
}

TEST_F(Extxyz, CompressedItIsTheSameText) {
  begin()->frame(specimen_.view(1e-3), specimen_.fields());
  begin({{"gzip", true}})->frame(specimen_.view(1e-3), specimen_.fields());
  const std::string plain = bytes_of(folder_.path() / "particles_000000.xyz");
  const fs::path packed = folder_.path() / "particles_000000.xyz.gz";
  EXPECT_LT(fs::file_size(packed), plain.size() * 6 / 10);
  const gzFile in = gzopen(packed.c_str(), "rb");
  ASSERT_NE(in, nullptr);
  std::string text(2 * plain.size(), '\0');
  text.resize(std::size_t(std::max(0, gzread(in, text.data(), unsigned(text.size())))));
  EXPECT_EQ(gzclose(in), Z_OK);
  EXPECT_EQ(text, plain);
}

TEST_F(Extxyz, AFullDiskIsAUserErrorAndLeavesNoFile) {
  auto output = begin();
  fs::create_symlink("/dev/full", folder_.path() / "particles_000000.xyz.partial");
  const std::string text = user_error([&] { output->frame(specimen_.view(0), {}); });
  EXPECT_EQ(text, "cannot write " + (folder_.path() / "particles_000000.xyz").string() + ": No space left on device");
  EXPECT_FALSE(fs::exists(folder_.path() / "particles_000000.xyz"));
}

}  // namespace
}  // namespace breccia::test
