// SPDX-License-Identifier: BSD-3-Clause
#include "qhull_hull.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

#include "breccia/error.hpp"

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace breccia {
namespace {

/// Qhull writes its complaints to a stream: this one is a string.
class TextStream {
 public:
  TextStream() : file_(open_memstream(&text_, &size_)) { BRECCIA_ASSERT(file_ != nullptr); }
  TextStream(const TextStream&) = delete;
  ~TextStream() {
    std::fclose(file_);
    std::free(text_);
  }
  FILE* file() { return file_; }
  std::string first_line() {
    std::fflush(file_);
    const std::string all(text_, size_);
    return all.substr(0, all.find('\n'));
  }

 private:
  char* text_ = nullptr;
  std::size_t size_ = 0;
  FILE* file_;
};

struct Qhull {
  qhT state;
  explicit Qhull(FILE* errors) { qh_zero(&state, errors); }
  Qhull(const Qhull&) = delete;
  ~Qhull() {
    int long_blocks = 0, long_bytes = 0;
    qh_freeqhull(&state, !qh_ALL);
    qh_memfreeshort(&state, &long_blocks, &long_bytes);
  }
};

}  // namespace

std::vector<Index> lower_hull(int dimension, std::vector<double> points) {
  const int count = int(points.size()) / dimension;
  // A point high above the middle closes the hull from above: the lower facets stay, the hull is never flat (a lattice
  // cell lifts to a plane), and Qhull need not work out the upper side.
  double highest = 0;
  for (int p = 0; p < count; ++p) highest = std::max(highest, points[std::size_t((p + 1) * dimension - 1)]);
  points.insert(points.end(), std::size_t(dimension - 1), 0.0);
  points.push_back(highest + 1);

  TextStream errors;
  const auto q = std::make_unique<Qhull>(errors.file());
  qhT* qh = &q->state;  // the name that Qhull's macros ask for
  char options[] = "qhull Qt Pp";
  const int code = qh_new_qhull(qh, dimension, count + 1, points.data(), False, options, nullptr, errors.file());
  if (code == qh_ERRmem) throw UserError("bagi_strain: not enough memory to triangulate the packing");
  if (code != 0)
    throw UserError(
        "bagi_strain: the particle centres of the packing could not be triangulated. Likely many of them "
        "coincide, or lie almost in one plane; check the packing for repeated particles. Qhull says: " +
        errors.first_line());

  std::vector<Index> corners;
  facetT* facet;
  vertexT *vertex, **vertexp;
  FORALLfacets {
    if (facet->normal[dimension - 1] >= 0) continue;
    const std::size_t before = corners.size();  // a vertical facet at the closing point may lean down by rounding
    bool closing = false;
    FOREACHvertex_(facet->vertices) {
      const int p = qh_pointid(qh, vertex->point);
      closing = closing || p == count;
      corners.push_back(Index(p));
    }
    if (closing) corners.resize(before);
  }
  return corners;
}

}  // namespace breccia
