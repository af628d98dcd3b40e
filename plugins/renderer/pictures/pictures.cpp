// SPDX-License-Identifier: BSD-3-Clause
/// Pictures of a finished run, drawn from its files on any machine: no display, no graphics card.
#include "breccia/renderer.hpp"

#include <algorithm>

#include "chart_pictures.hpp"
#include "scene_pictures.hpp"

namespace breccia {
namespace fs = std::filesystem;
using namespace pictures;

enum class Motif { specimen, cutaway, cracks, cracks_time, displacement, stress_strain, strains };

struct PictureConfig {
  Motif show;
  std::optional<std::string> name, field;
  ColourMap colour_map;
  std::optional<double> low, high;
  std::optional<long> frame;
  Cut cut;

  static void describe(Schema<PictureConfig>& s) {
    s.param("show", &PictureConfig::show)
        .choice("specimen", Motif::specimen, "the particles, coloured by `field`")
        .choice("cutaway", Motif::cutaway, "the same with a part cut away (`cut`)")
        .choice("cracks", Motif::cracks, "broken bonds as discs, coloured by tension and shear")
        .choice("cracks_time", Motif::cracks_time, "broken bonds as discs, coloured by when they broke")
        .choice("displacement", Motif::displacement, "the particles, coloured by the magnitude of their displacement")
        .choice("stress_strain", Motif::stress_strain, "axial stress and damage against axial strain, .png and .svg")
        .choice("strains", Motif::strains, "lateral and volumetric strain against axial strain, .png and .svg")
        .doc("what the picture shows");
    s.param("name", &PictureConfig::name)
        .example("inside")
        .doc("file name without its ending; the value of `show` if absent");
    s.param("field", &PictureConfig::field)
        .example("velocity_z")
        .doc(
            "particle field of the colours; of a vector its magnitude, or a component (`_x`, `_y`, `_z`); `damage`, or "
            "else the displacement, if absent");
    s.param("colour_map", &PictureConfig::colour_map)
        .choice("automatic", ColourMap::automatic, "by the kind of field")
        .choice("viridis", ColourMap::viridis, "dark blue to yellow")
        .choice("cividis", ColourMap::cividis, "blue to yellow, the same to all eyes")
        .choice("inferno", ColourMap::inferno, "black to yellow")
        .choice("orange_red", ColourMap::orange_red, "pale stone to dark red")
        .choice("blue_red", ColourMap::blue_red, "diverging")
        .choice("grey", ColourMap::grey, "light to dark grey")
        .fallback("automatic")
        .doc("colours of the values");
    s.param("low", &PictureConfig::low).doc("value at the lower end of the colour bar, in the SI unit of the field");
    s.param("high", &PictureConfig::high).doc("value at the upper end of the colour bar, in the SI unit of the field");
    s.param("frame", &PictureConfig::frame).at_least(0).doc("which frame, counted from 0; the last if absent");
    s.param("cut", &PictureConfig::cut)
        .choice("quarter", Cut::quarter, "a quarter").choice("half", Cut::half, "the front half")
        .fallback("quarter").doc("what a cutaway takes away");
  }
};

class Pictures final : public Renderer {
 public:
  struct Config {
    std::vector<PictureConfig> pictures;
    long size;
    Vec3 background;
    CurveNames columns;
  };

  static void describe(Schema<Config>& s) {
    s.summary("Pictures for papers: specimen, inside, cracks, displacements and curves")
        .details(
            "Reads `particles.pvd`, `bonds.pvd` and `curves.csv` of a result folder, or one .pvd or .vtp file, and "
            "draws "
            "with OpenGL through EGL, in software if need be. A picture whose data are missing is skipped with a "
            "warning; "
            "the others are made.")
        .source(
            "colour maps: viridis, inferno (Smith, van der Walt), cividis (Nuñez et al. 2018), OrRd, RdBu (Brewer); "
            "mode colours: Okabe and Ito");
    Json all = Json::array();
    for (const char* motif :
         {"specimen", "cutaway", "cracks", "cracks_time", "displacement", "stress_strain", "strains"})
      all.push_back({{"show", motif}, {"colour_map", "automatic"}, {"cut", "quarter"}});
    s.param("pictures", &Config::pictures).items(1, 1000).fallback(all).doc("what to draw; one of each kind if absent");
    s.param("size", &Config::size).at_least(200).at_most(8000).fallback(1600)
        .doc("pixels: height of a picture of the specimen, width of a chart");
    s.param("background", &Config::background).at_least(0).at_most(1).fallback({1, 1, 1})
        .doc("red, green and blue of the background");
    s.param("columns", &Config::columns)
        .fallback({{"strain", "axial_strain"},
                   {"stress", "axial_stress"},
                   {"damage", "global_damage"},
                   {"lateral_strain", "lateral_strain"}})
        .doc("columns of curves.csv, by header (`axial_stress_Pa`) or by name without the unit");
    s.check([](const Config& c, Issues& issues) {
      std::vector<std::string> names;
      for (std::size_t k = 0; k < c.pictures.size(); ++k) {
        const std::string name = file_name(c.pictures[k]), path = "pictures[" + std::to_string(k) + "]";
        if (name.empty() || name.find('/') != name.npos)
          issues.push_back({path + ".name", "`" + name + "` cannot be a file name"});
        if (std::find(names.begin(), names.end(), name) != names.end())
          issues.push_back({path, "a second picture named `" + name + "`: give one of them another `name`"});
        names.push_back(name);
      }
    });
  }

  explicit Pictures(const Config& config) : config_(config) {}

  std::vector<fs::path> render(const RenderRequest& request, Host& host) override {
    const Results results = find_results(request.source);
    Canvas(16, 16, Vec3::Ones());  // Unavailable, if it must be, before any work
    std::error_code error;
    fs::create_directories(request.directory, error);
    if (error)
      throw UserError("renderer pictures: cannot make the folder " + request.directory.string() + ": " +
                      error.message());

    std::vector<fs::path> made;
    std::string last_problem;
    for (std::size_t k = 0; k < config_.pictures.size(); ++k) {
      if (host.cancelled()) throw Cancelled();
      host.progress("pictures", double(k) / double(config_.pictures.size()));
      const PictureConfig& picture = config_.pictures[k];
      try {
        draw(picture, results, request.directory, made);
      } catch (const UserError& e) {
        last_problem = "picture `" + file_name(picture) + "` was not made: " + e.what();
        host.warn(last_problem);
      }
    }
    if (made.empty()) throw UserError("renderer pictures: no picture could be made; " + last_problem);
    return made;
  }

 private:
  static std::string file_name(const PictureConfig& p) {
    constexpr const char* names[] = {"specimen",     "cutaway",       "cracks", "cracks_time",
                                     "displacement", "stress_strain", "strains"};
    return p.name.value_or(names[int(p.show)]);
  }

  static const fs::path& pick(const std::vector<fs::path>& frames, const std::optional<long>& index, const char* what) {
    if (frames.empty()) throw UserError(std::string("there are no frames of ") + what);
    if (!index) return frames.back();
    if (std::size_t(*index) >= frames.size())
      throw UserError("there is no frame " + std::to_string(*index) + ": the last is " +
                      std::to_string(frames.size() - 1));
    return frames[std::size_t(*index)];
  }

  void draw(const PictureConfig& p, const Results& results, const fs::path& directory,
            std::vector<fs::path>& made) const {
    const Sheet sheet{int(config_.size), config_.background};
    const fs::path png = directory / (file_name(p) + ".png"), svg = directory / (file_name(p) + ".svg");
    switch (p.show) {
      case Motif::specimen:
      case Motif::cutaway:
      case Motif::displacement: {
        SpecimenPicture specimen{p.field.value_or(p.show == Motif::displacement ? "displacement" : ""), p.colour_map,
                                 p.low, p.high, p.show == Motif::cutaway ? p.cut : Cut::none};
        draw_specimen(read_frame(pick(results.particle_frames, p.frame, "particles")), specimen, sheet, png);
        break;
      }
      case Motif::cracks:
      case Motif::cracks_time:
        draw_cracks(read_frame(pick(results.bond_frames, p.frame, "bonds")),
                    p.show == Motif::cracks ? CrackColour::mode : CrackColour::time, p.colour_map, sheet, png);
        break;
      case Motif::stress_strain:
      case Motif::strains: {
        if (results.curves.empty()) throw UserError("there is no curves.csv");
        const CurvesFile curves(results.curves);
        const Chart chart = p.show == Motif::strains ? strains_chart(curves, config_.columns)
                                                     : stress_strain_chart(curves, config_.columns);
        const ChartLayout layout = layout_of(chart, sheet);
        write_png(chart, layout, sheet, png);
        write_svg(chart, layout, sheet, svg);
        made.push_back(png);
        made.push_back(svg);
        return;
      }
    }
    made.push_back(png);
  }

  Config config_;
};

}  // namespace breccia

BRECCIA_PLUGIN(breccia::Pictures, "renderer", "pictures")
