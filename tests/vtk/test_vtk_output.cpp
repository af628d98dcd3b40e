// SPDX-License-Identifier: BSD-3-Clause
#include <unistd.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>

#include "breccia/output.hpp"
#include "plugin_under_test.hpp"
#include "specimen.hpp"

namespace breccia::test {
namespace {
namespace fs = std::filesystem;

vtkSmartPointer<vtkPolyData> read(const fs::path& file) {
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

Vec3 vector_at(vtkFieldData* data, const char* name, vtkIdType k) {
  Vec3 v;
  data->GetArray(name)->GetTuple(k, v.data());
  return v;
}

class VtkOutput : public ::testing::Test {
 protected:
  std::unique_ptr<Output> begin(const Json& config = {}) {
    auto output = make<Output>(BRECCIA_VTK_PLUGIN, config);
    output->begin(folder_.path(), host_);
    return output;
  }
  Folder folder_;
  QuietHost host_;
  Specimen specimen_{400, 3};
};

TEST_F(VtkOutput, ParticlesComeBackAsTheyWere) {
  begin({{"precision", "double"}})->frame(specimen_.view(2.5e-3), specimen_.fields());
  const auto data = read(folder_.path() / "particles_000000.vtp");
  const ParticlesView p = specimen_.view(0).particles;
  ASSERT_EQ(data->GetNumberOfPoints(), vtkIdType(p.size()));
  ASSERT_EQ(data->GetNumberOfVerts(), vtkIdType(p.size()));
  vtkPointData* on = data->GetPointData();
  for (std::size_t k = 0; k < p.size(); ++k) {
    const vtkIdType n = vtkIdType(k);
    EXPECT_EQ(Vec3(data->GetPoint(n)), p.position[k]);
    EXPECT_EQ(on->GetArray("radius")->GetTuple1(n), p.radius[k]);
    EXPECT_EQ(on->GetArray("mass")->GetTuple1(n), p.mass[k]);
    EXPECT_EQ(on->GetArray("id")->GetTuple1(n), p.id[k]);
    EXPECT_EQ(vector_at(on, "displacement", n), p.position[k] - p.initial_position[k]);
    EXPECT_EQ(vector_at(on, "velocity", n), p.velocity[k]);
    EXPECT_EQ(vector_at(on, "angular_velocity", n), p.angular_velocity[k]);
    EXPECT_EQ(vector_at(on, "force", n), p.force[k]);
    EXPECT_EQ(on->GetArray("damage")->GetTuple1(n), specimen_.fields()[0].values[k]);
  }
  EXPECT_FALSE(on->HasArray("length_change"));
  EXPECT_EQ(data->GetFieldData()->GetArray("TimeValue")->GetTuple1(0), 2.5e-3);
  EXPECT_STREQ(on->GetArray("velocity")->GetInformation()->Get(vtkDataArray::UNITS_LABEL()), "m/s");
}

TEST_F(VtkOutput, SinglePrecisionRoundsFieldsOnly) {
  begin()->frame(specimen_.view(0), specimen_.fields());
  const auto data = read(folder_.path() / "particles_000000.vtp");
  const ParticlesView p = specimen_.view(0).particles;
  EXPECT_EQ(data->GetPointData()->GetArray("velocity")->GetDataType(), VTK_FLOAT);
  EXPECT_EQ(data->GetPointData()->GetArray("radius")->GetDataType(), VTK_DOUBLE);
  EXPECT_EQ(Vec3(data->GetPoint(7)), p.position[7]);
  EXPECT_EQ(vector_at(data->GetPointData(), "velocity", 7), p.velocity[7].cast<float>().cast<double>());
}

TEST_F(VtkOutput, BondsComeBackWithTheForcesOfTheirPairs) {
  begin({{"precision", "double"}})->frame(specimen_.view(0), specimen_.fields());
  const auto data = read(folder_.path() / "bonds_000000.vtp");
  const SimulationView view = specimen_.view(0);
  const BondsView& b = view.bonds;
  ASSERT_EQ(data->GetNumberOfLines(), vtkIdType(b.size()));
  vtkCellData* on = data->GetCellData();
  std::size_t parted = 0, tension = 0;
  for (std::size_t k = 0; k < b.size(); ++k) {
    const vtkIdType n = vtkIdType(k);
    vtkNew<vtkIdList> ends;
    data->GetCellPoints(n, ends);
    EXPECT_EQ(ends->GetId(0), b.i[k]);
    EXPECT_EQ(ends->GetId(1), b.j[k]);
    EXPECT_EQ(on->GetArray("state")->GetTuple1(n), double(b.state[k]));
    EXPECT_EQ(on->GetArray("break_time")->GetTuple1(n), b.crack(k) ? b.crack(k)->time : -1);
    EXPECT_EQ(vector_at(on, "break_position", n), (b.crack(k) ? b.crack(k)->position : Vec3(0, 0, 0)));
    EXPECT_EQ(vector_at(on, "break_normal", n), (b.crack(k) ? b.crack(k)->normal : Vec3(0, 0, 0)));
    EXPECT_EQ(on->GetArray("released_energy")->GetTuple1(n), b.crack(k) ? b.crack(k)->energy : 0);
    EXPECT_EQ(on->GetArray("initial_distance")->GetTuple1(n), b.initial_distance[k]);
    EXPECT_EQ(on->GetArray("crack_radius")->GetTuple1(n),
              std::min(view.particles.radius[b.i[k]], view.particles.radius[b.j[k]]));
    EXPECT_EQ(on->GetArray("length_change")->GetTuple1(n), specimen_.fields()[1].values[k]);
    const double normal = on->GetArray("force_normal")->GetTuple1(n), shear = on->GetArray("force_shear")->GetTuple1(n);
    const Vec3 force = vector_at(on, "force", n);
    EXPECT_NEAR(std::hypot(normal, shear), force.norm(), 1e-12);
    if (b.pair[k] == BondsView::no_pair) {
      EXPECT_EQ(force, Vec3::Zero());
      ++parted;
    } else {
      const PairForce& f = view.pairs.force[b.pair[k]];
      EXPECT_EQ(force, Vec3(f.fx, f.fy, f.fz));
      tension += normal > 0;
    }
  }
  EXPECT_GT(parted, 0u);
  EXPECT_GT(tension, 0u);  // intact pairs of the specimen pull
}

TEST_F(VtkOutput, CracksArePointsWithWhatIsKnownOfThem) {
  begin({{"precision", "double"}})->frame(specimen_.view(0), {});
  const auto data = read(folder_.path() / "cracks_000000.vtp");
  const SimulationView view = specimen_.view(0);
  const BondsView& b = view.bonds;
  ASSERT_GT(b.cracks.size(), 20u);
  ASSERT_EQ(data->GetNumberOfPoints(), vtkIdType(b.cracks.size()));
  ASSERT_EQ(data->GetNumberOfVerts(), vtkIdType(b.cracks.size()));
  vtkPointData* on = data->GetPointData();
  for (std::size_t k = 0; k < b.size(); ++k) {
    if (!b.crack(k)) continue;
    const Crack& c = *b.crack(k);
    const vtkIdType n = b.crack_of[k];
    const auto of = [&](const char* name) { return on->GetArray(name)->GetTuple1(n); };
    EXPECT_EQ(Vec3(data->GetPoint(n)), c.position);
    EXPECT_EQ(vector_at(on, "normal", n), c.normal);
    EXPECT_EQ(of("time"), c.time);
    EXPECT_EQ(of("energy"), c.energy);
    EXPECT_EQ(of("mode"), double(b.state[k]));
    EXPECT_EQ(of("particle_i"), view.particles.id[b.i[k]]);
    EXPECT_EQ(of("particle_j"), view.particles.id[b.j[k]]);
    const double r = std::min(view.particles.radius[b.i[k]], view.particles.radius[b.j[k]]);
    EXPECT_EQ(of("half_length"), r);
    EXPECT_NEAR(of("area"), M_PI * r * r, 1e-15 * r);
  }
  EXPECT_STREQ(on->GetArray("energy")->GetInformation()->Get(vtkDataArray::UNITS_LABEL()), "J");
  EXPECT_EQ(on->GetArray("material_i"), nullptr) << "there is but one";
}

TEST_F(VtkOutput, ACrackInThePlaneIsALineAsThickAsTheDiscs) {
  const Specimen discs(200, 2);
  SimulationView view = discs.view(0);
  view.thickness = 0.02;
  begin({{"precision", "double"}})->frame(view, {});
  const auto data = read(folder_.path() / "cracks_000000.vtp");
  ASSERT_GT(data->GetNumberOfPoints(), 0);
  for (vtkIdType n = 0; n < data->GetNumberOfPoints(); ++n)
    EXPECT_DOUBLE_EQ(data->GetPointData()->GetArray("area")->GetTuple1(n),
                     2 * data->GetPointData()->GetArray("half_length")->GetTuple1(n) * 0.02);
}

TEST_F(VtkOutput, CracksKnowTheirMaterials) {
  SimulationView view = specimen_.view(0);
  const std::vector<std::string> names = {"quartz", "mica"};
  std::vector<std::uint8_t> material(view.particles.size());
  for (std::size_t k = 0; k < material.size(); ++k) material[k] = k % 3 == 0;
  view.materials = names;
  view.particles.material = material;
  begin()->frame(view, {});
  const auto data = read(folder_.path() / "cracks_000000.vtp");
  const BondsView& b = view.bonds;
  for (std::size_t k = 0; k < b.size(); ++k)
    if (b.crack(k)) {
      EXPECT_EQ(data->GetPointData()->GetArray("material_i")->GetTuple1(b.crack_of[k]), material[b.i[k]]);
      EXPECT_EQ(data->GetPointData()->GetArray("material_j")->GetTuple1(b.crack_of[k]), material[b.j[k]]);
    }
  const auto* kept = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray("material_names"));
  ASSERT_NE(kept, nullptr);
  EXPECT_EQ(kept->GetNumberOfValues(), 2);
}

TEST_F(VtkOutput, WholeNumbersAreIntegersAndTensorsNameTheirComponents) {
  const std::size_t n = 400;
  std::vector<double> few(n), many(n), tensor(6 * n);
  for (std::size_t k = 0; k < n; ++k) {
    few[k] = double(k % 13);
    many[k] = 1e10 + double(k);
  }
  for (std::size_t k = 0; k < 6 * n; ++k) tensor[k] = double(k);
  const Field fields[] = {{Field::On::particles, "fragment_id", "1", 1, few, true},
                          {Field::On::particles, "many", "1", 1, many, true},
                          {Field::On::particles, "stress", "Pa", 6, tensor}};
  begin()->frame(specimen_.view(0), fields);
  const auto data = read(folder_.path() / "particles_000000.vtp");
  vtkPointData* on = data->GetPointData();
  EXPECT_EQ(on->GetArray("fragment_id")->GetDataTypeSize(), 4);
  EXPECT_EQ(on->GetArray("fragment_id")->GetDataType(), VTK_INT);
  EXPECT_EQ(on->GetArray("many")->GetDataTypeSize(), 8);
  EXPECT_FALSE(on->GetArray("many")->GetDataType() == VTK_DOUBLE);
  for (std::size_t k = 0; k < n; ++k) {
    EXPECT_EQ(on->GetArray("fragment_id")->GetTuple1(vtkIdType(k)), few[k]);
    EXPECT_EQ(on->GetArray("many")->GetTuple1(vtkIdType(k)), many[k]);
  }
  ASSERT_EQ(on->GetArray("stress")->GetNumberOfComponents(), 6);
  EXPECT_STREQ(on->GetArray("stress")->GetComponentName(0), "xx");
  EXPECT_STREQ(on->GetArray("stress")->GetComponentName(5), "xz");
  few[3] = 0.5;
  const Field half{Field::On::particles, "fragment_id", "1", 1, few, true};
  EXPECT_NE(user_error([&] {
              begin()->frame(specimen_.view(0), {&half, 1});
            }).find("field `fragment_id` is said to hold whole numbers, and holds 0.5"),
            std::string::npos);
}

TEST_F(VtkOutput, WallsAreSquaresInTheirPlanes) {
  begin()->frame(specimen_.view(0), {});
  const auto data = read(folder_.path() / "walls_000000.vtp");
  ASSERT_EQ(data->GetNumberOfPolys(), 2);
  const auto walls = specimen_.view(0).walls;
  EXPECT_EQ(vtkStringArray::SafeDownCast(data->GetCellData()->GetAbstractArray("name"))->GetValue(1), "top");
  EXPECT_EQ(vector_at(data->GetCellData(), "force", 1), walls[1].force);
  for (vtkIdType c = 0; c < 2; ++c)
    for (vtkIdType k = 4 * c; k < 4 * c + 4; ++k)
      EXPECT_NEAR((Vec3(data->GetPoint(k)) - walls[std::size_t(c)].point).dot(walls[std::size_t(c)].normal), 0, 1e-15);
}

TEST_F(VtkOutput, TheCollectionListsEveryFrameAfterEachFrame) {
  auto output = begin();
  for (int k = 0; k < 3; ++k) {
    output->frame(specimen_.view(k * 1e-4), {});
    const std::string pvd = text_of(folder_.path() / "particles.pvd");
    for (int m = 0; m < 3; ++m)
      EXPECT_EQ(pvd.find("particles_00000" + std::to_string(m) + ".vtp") != std::string::npos, m <= k);
    EXPECT_NE(pvd.find("timestep=\"" +
                       std::string(k == 0   ? "0"
                                   : k == 1 ? "1e-04"
                                            : "2e-04") +
                       "\""),
              std::string::npos)
        << pvd;
  }
  for (const auto& entry : fs::directory_iterator(folder_.path())) EXPECT_NE(entry.path().extension(), ".partial");
}

TEST_F(VtkOutput, AResumedRunKeepsTheEarlierFramesOnly) {
  auto first = begin();
  for (const double time : {0.0, 1e-4, 2e-4, 3e-4}) first->frame(specimen_.view(time), {});
  begin()->frame(specimen_.view(2e-4), {});
  const std::string pvd = text_of(folder_.path() / "bonds.pvd");
  EXPECT_NE(pvd.find("bonds_000001.vtp"), std::string::npos);
  EXPECT_NE(pvd.find("bonds_000002.vtp"), std::string::npos);
  EXPECT_EQ(pvd.find("bonds_000003.vtp"), std::string::npos);
  begin()->frame(specimen_.view(0), {});  // a fresh run lists nothing of the old one
  EXPECT_EQ(text_of(folder_.path() / "bonds.pvd").find("bonds_000001.vtp"), std::string::npos);
}

TEST_F(VtkOutput, SameStateGivesTheSameBytes) {
  auto output = begin();
  output->frame(specimen_.view(1e-4), specimen_.fields());
  output->frame(specimen_.view(1e-4), specimen_.fields());
  EXPECT_EQ(text_of(folder_.path() / "particles_000000.vtp"), text_of(folder_.path() / "particles_000001.vtp"));
}

TEST_F(VtkOutput, FieldsThatCannotBeWrittenAreNamed) {
  const Field taken{Field::On::particles, "mass", "kg", 1, std::vector<double>(400, 0.0)};
  const Field shorter{Field::On::particles, "heat", "J", 1, {1, 2, 3}};
  EXPECT_NE(user_error([&] {
              begin()->frame(specimen_.view(0), {&taken, 1});
            }).find("two fields are named `mass`"),
            std::string::npos);
  EXPECT_NE(user_error([&] {
              begin()->frame(specimen_.view(0), {&shorter, 1});
            }).find("field `heat` has 3 values"),
            std::string::npos);
}

TEST_F(VtkOutput, AVanishedFolderIsAUserError) {
  auto output = begin();
  fs::remove_all(folder_.path());
  EXPECT_NE(user_error([&] {
              output->frame(specimen_.view(0), {});
            }).find("cannot write " + (folder_.path() / "particles_000000.vtp").string()),
            std::string::npos);
}

TEST_F(VtkOutput, AFolderThatCannotBeMadeIsAUserError) {
  const fs::path file = folder_.file("in_the_way", "");
  auto output = make<Output>(BRECCIA_VTK_PLUGIN, {});
  EXPECT_NE(user_error([&] { output->begin(file / "sub", host_); }).find("cannot make the folder"), std::string::npos);
}

/// The device that is always full stands in for a full disk: the writer's temporary name leads to it.
TEST_F(VtkOutput, AFullDiskIsAUserErrorAndLeavesNoFile) {
  auto output = begin();
  ASSERT_EQ(symlink("/dev/full", (folder_.path() / "particles_000000.vtp.partial").c_str()), 0);
  const std::string text = user_error([&] { output->frame(specimen_.view(0), {}); });
  EXPECT_EQ(text, "cannot write " + (folder_.path() / "particles_000000.vtp").string() + ": No space left on device");
  EXPECT_FALSE(fs::exists(folder_.path() / "particles_000000.vtp"));
  EXPECT_FALSE(fs::exists(folder_.path() / "particles.pvd"));
}

TEST_F(VtkOutput, AFullDiskAtTheCollectionIsAUserError) {
  auto output = begin();
  ASSERT_EQ(symlink("/dev/full", (folder_.path() / "particles.pvd.partial").c_str()), 0);
  EXPECT_NE(user_error([&] { output->frame(specimen_.view(0), {}); }).find("particles.pvd: No space left on device"),
            std::string::npos);
  EXPECT_FALSE(fs::exists(folder_.path() / "particles.pvd"));
}

TEST_F(VtkOutput, NoParticlesNoBondsNoWalls) {
  begin()->frame(SimulationView{}, {});
  EXPECT_EQ(read(folder_.path() / "particles_000000.vtp")->GetNumberOfPoints(), 0);
  EXPECT_FALSE(fs::exists(folder_.path() / "walls.pvd"));
}

}  // namespace
}  // namespace breccia::test
