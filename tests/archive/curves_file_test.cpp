// SPDX-License-Identifier: BSD-3-Clause
// Curves in HDF5, read back by the library itself rather than by what wrote them.
#include "archive/curves_file.hpp"

#include <gtest/gtest.h>
#include <hdf5.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "breccia/error.hpp"

namespace breccia {
namespace {

namespace fs = std::filesystem;

struct TwoCurves final : Curves {
  std::vector<Column> named = {{"time", "s", "since loading began"},
                               {"axial_strain", "1", "of the platens \u2014 both"}};
  std::vector<double> values[2];
  explicit TwoCurves(std::size_t rows) {
    for (std::size_t k = 0; k < rows; ++k) {
      values[0].push_back(1e-7 * double(k) / 3);
      values[1].push_back(k % 7 == 3 ? std::numeric_limits<double>::quiet_NaN() : -std::sqrt(double(k)));
    }
  }
  const std::vector<Column>& columns() const override { return named; }
  std::span<const double> column(std::string_view name) const override { return values[name == "time" ? 0 : 1]; }
  std::size_t rows() const override { return values[0].size(); }
};

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string text_of(hid_t object, const char* name) {
  const hid_t attribute = H5Aopen(object, name, H5P_DEFAULT), type = H5Aget_type(attribute);
  std::string text(H5Tget_size(type), '\0');
  EXPECT_GE(H5Aread(attribute, type, text.data()), 0) << name;
  H5Tclose(type);
  H5Aclose(attribute);
  return text.c_str();
}

class CurvesFile : public testing::TestWithParam<std::size_t> {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "breccia-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path folder_;
};

TEST_P(CurvesFile, HasEachCurveWithItsUnitBitForBit) {
  const TwoCurves curves(GetParam());
  const fs::path file = folder_ / "curves.h5", again = folder_ / "again.h5";
  write_curves_hdf5(file, curves);
  write_curves_hdf5(again, curves);
  EXPECT_TRUE(bytes_of(file) == bytes_of(again)) << "the same curves, the same bytes";
  const hid_t open = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ASSERT_GE(open, 0);
  EXPECT_EQ(text_of(open, "format"), "breccia curves 1");
  for (std::size_t c = 0; c < 2; ++c) {
    const Column& column = curves.named[c];
    const hid_t set = H5Dopen2(open, column.name.c_str(), H5P_DEFAULT), space = H5Dget_space(set);
    ASSERT_GE(set, 0) << column.name;
    hsize_t size = 0;
    ASSERT_EQ(H5Sget_simple_extent_ndims(space), 1);
    H5Sget_simple_extent_dims(space, &size, nullptr);
    ASSERT_EQ(size, GetParam());
    std::vector<double> read(size);
    if (size > 0) { ASSERT_GE(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, read.data()), 0); }
    for (std::size_t k = 0; k < size; ++k) {
      const double was = curves.values[c][k];
      EXPECT_TRUE(read[k] == was || (std::isnan(read[k]) && std::isnan(was))) << column.name << " " << k;
    }
    EXPECT_EQ(text_of(set, "unit"), column.unit);
    EXPECT_EQ(text_of(set, "description"), column.doc);
    H5Sclose(space);
    H5Dclose(set);
  }
  H5Fclose(open);
}

TEST_P(CurvesFile, AFolderThatIsGoneIsTheUsersError) {
  fs::remove_all(folder_);
  EXPECT_THROW(write_curves_hdf5(folder_ / "curves.h5", TwoCurves(GetParam())), UserError);
}

INSTANTIATE_TEST_SUITE_P(Rows, CurvesFile, testing::Values(0, 1, 64, 65, 5000));

}  // namespace
}  // namespace breccia
