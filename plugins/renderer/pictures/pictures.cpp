// SPDX-License-Identifier: BSD-3-Clause
/// Pictures of a finished run, drawn from its files on any machine: no display, no graphics card.
#include <algorithm>

#include "breccia/atomic_file.hpp"
#include "breccia/renderer.hpp"
#include "chart_pictures.hpp"
#include "comparison.hpp"
#include "scene_pictures.hpp"
#include "strength_chart.hpp"
#include "table_pictures.hpp"

namespace breccia {
namespace fs = std::filesystem;
using namespace pictures;

enum class Motif { specimen, cutaway, cracks, cracks_time, displacement, stress_strain, load_curve, strains, tables };

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
        .choice("load_curve", Motif::load_curve, "load and damage against the platens' displacement, .png and .svg")
        .choice("strains", Motif::strains, "lateral and volumetric strain against axial strain, .png and .svg")
        .choice("tables", Motif::tables,
                "histograms, roses and profiles of the run's tables, if any: <table>.png and .svg each")
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
        .choice("quarter", Cut::quarter, "a quarter")
        .choice("half", Cut::half, "the front half")
        .fallback("quarter")
        .doc("what a cutaway takes away");
  }
};

class Pictures final : public Renderer {
 public:
  struct Config {
    std::optional<std::vector<PictureConfig>> pictures;
    long size;
    Vec3 background;
    CurveNames columns;
    std::optional<std::vector<Comparison>> comparisons;
    bool strength_envelope;
  };

  static void describe(Schema<Config>& s) {
    s.summary("Pictures for papers: specimen, inside, cracks, displacements and curves")
        .details(
            "Reads `particles.pvd`, `bonds.pvd` and `curves.csv` of a result folder, or one .pvd or .vtp file, and "
            "draws "
            "on the processor: neither a display nor a graphics card is needed. A picture whose data are missing is "
            "skipped with a warning; the others are made.")
        .source(
            "colour maps: viridis, inferno (Smith, van der Walt), cividis (Nuñez et al. 2018), OrRd, RdBu (Brewer); "
            "mode colours: Okabe and Ito");
    s.param("pictures", &Config::pictures)
        .items(1, 1000)
        .doc(
            "what to draw; if absent, as far as the run has the data for them: `specimen`, `cutaway` (three "
            "dimensions), `cracks`, and `load_curve` or else `stress_strain`; of tables alone `tables`");
    s.param("size", &Config::size)
        .at_least(200)
        .at_most(8000)
        .fallback(1600)
        .doc("pixels: height of a picture of the specimen, width of a chart");
    s.param("background", &Config::background)
        .at_least(0)
        .at_most(1)
        .fallback({1, 1, 1})
        .doc("red, green and blue of the background");
    s.param("columns", &Config::columns)
        .fallback({{"damage", "global_damage"},
                   {"lateral_strain", "lateral_strain"},
                   {"displacement", "platen_displacement"},
                   {"load", "load"}})
        .doc("columns of curves.csv, by header (`axial_stress_Pa`) or by name without the unit");
    s.param("comparisons", &Config::comparisons)
        .items(1, 1000)
        .doc(
            "what `breccia compare` draws of several runs; if absent `stress_strain`, `broken_tension`, `broken_shear` "
            "and "
            "`global_damage` over the axial strain, as far as the runs have these columns");
    s.param("strength_envelope", &Config::strength_envelope)
        .fallback(true)
        .doc(
            "`breccia compare` of tests at different confining pressures also draws their Mohr circles at failure and "
            "the Mohr-Coulomb line");
    s.check([](const Config& c, Issues& issues) {
      std::vector<std::string> pictures, comparisons;
      for (const PictureConfig& p : c.pictures.value_or(std::vector<PictureConfig>{})) pictures.push_back(file_name(p));
      for (const Comparison& k : c.comparisons.value_or(std::vector<Comparison>{}))
        comparisons.push_back(k.file_name());
      check_names("pictures", pictures, issues);
      check_names("comparisons", comparisons, issues);
      for (std::size_t k = 0; k < comparisons.size(); ++k)
        if (c.strength_envelope && comparisons[k] == "strength_envelope")
          issues.push_back(
              {"comparisons[" + std::to_string(k) + "]", "`strength_envelope` is drawn, too: choose another `name`"});
    });
  }

  explicit Pictures(const Config& config) : config_(config) {}

  std::vector<fs::path> render(const RenderRequest& request, Host& host) override {
    const RunResults results = find_results(request.source);
    std::error_code error;
    fs::create_directories(request.directory, error);
    if (error)
      throw UserError("renderer pictures: cannot make the folder " + request.directory.string() + ": " +
                      error.message());

    const std::vector<PictureConfig> pictures = config_.pictures ? *config_.pictures : usual_pictures(results);
    const Sheet sheet{int(config_.size), config_.background, host.threads()};
    std::vector<fs::path> made;
    std::string last_problem = "the run has none of the data they need";
    for (std::size_t k = 0; k < pictures.size(); ++k) {
      if (host.cancelled()) throw Cancelled();
      host.progress("pictures", double(k) / double(pictures.size()));
      const PictureConfig& picture = pictures[k];
      try {
        draw(picture, results, sheet, request.directory, made);
      } catch (const CannotWrite&) { throw; } catch (const UserError& e) {
        last_problem = "picture `" + file_name(picture) + "` was not made: " + e.what();
        host.warn(last_problem);
      }
    }
    host.progress("pictures", 1);
    if (made.empty()) throw UserError("renderer pictures: no picture could be made; " + last_problem);
    return made;
  }

  std::vector<fs::path> compare(const ComparisonRequest& request, Host& host) override {
    std::vector<LabelledCurves> runs;
    for (const ComparisonRequest::Run& run : request.runs)
      runs.push_back({run.label, CurvesFile(run.folder / "curves.csv")});
    const Sheet sheet{int(config_.size), config_.background};
    std::vector<std::pair<std::string, Chart>> charts;
    for (const Comparison& c : config_.comparisons.value_or(usual_comparisons())) {
      std::vector<std::string> missing;
      try {
        Chart chart = comparison_chart(runs, c, missing);
        layout_of(chart, sheet);  // its complaints, too, before anything is written
        charts.emplace_back(c.file_name(), std::move(chart));
      } catch (const UserError& e) {
        const std::string problem = "chart `" + c.file_name() + "` cannot be drawn: " + e.what();
        if (config_.comparisons) throw UserError("renderer pictures: " + problem);
        host.info(problem);
        continue;
      }
      for (const std::string& label : missing)
        host.warn("chart `" + c.file_name() + "` is without `" + label + "`, which lacks the column `" + c.x +
                  "` or `" + c.y + "`");
    }
    if (config_.strength_envelope)
      if (auto envelope = strength_envelope_chart(request.runs))
        charts.emplace_back("strength_envelope", std::move(*envelope));
    std::vector<fs::path> made;
    for (const auto& [name, chart] : charts) {
      if (host.cancelled()) throw Cancelled();
      write_chart(chart, sheet, request.directory / name, made);
    }
    return made;
  }

  std::vector<fs::path> chart(const StudyChart& study, Host&) override {
    const Sheet sheet{int(config_.size), config_.background};
    const Chart chart = study_chart(study);
    layout_of(chart, sheet);
    std::vector<fs::path> made;
    write_chart(chart, sheet, study.file, made);
    return made;
  }

 private:
  static void check_names(const std::string& list, const std::vector<std::string>& names, Issues& issues) {
    for (std::size_t k = 0; k < names.size(); ++k) {
      const std::string path = list + "[" + std::to_string(k) + "]";
      if (names[k].empty() || names[k].find('/') != std::string::npos)
        issues.push_back({path + ".name", "`" + names[k] + "` cannot be a file name"});
      if (std::find(names.begin(), names.begin() + std::ptrdiff_t(k), names[k]) != names.begin() + std::ptrdiff_t(k))
        issues.push_back({path, "a second picture named `" + names[k] + "`: give one of them another `name`"});
    }
  }

  static std::string file_name(const PictureConfig& p) {
    constexpr const char* names[] = {"specimen",      "cutaway",    "cracks",  "cracks_time", "displacement",
                                     "stress_strain", "load_curve", "strains", "tables"};
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

  /// What a run of any kind can show, without a word about what it is not made to show.
  std::vector<PictureConfig> usual_pictures(const RunResults& results) const {
    std::vector<PictureConfig> usual;
    const auto add = [&](Motif show) {
      usual.push_back({show, {}, {}, ColourMap::automatic, {}, {}, {}, Cut::quarter});
    };
    if (!results.particle_frames.empty()) {
      add(Motif::specimen);
      if (facts_of(read_frame(results.particle_frames.back())).dimension == 3) add(Motif::cutaway);
    }
    if (!results.bond_frames.empty()) add(Motif::cracks);
    if (!results.curves.empty()) {
      const CurvesFile curves(results.curves);
      if (has_load(curves, config_.columns)) add(Motif::load_curve);
      else if (has_stress_strain(curves, config_.columns)) add(Motif::stress_strain);
    }
    if (usual.empty() && !results.tables.empty()) add(Motif::tables);
    return usual;
  }

  void draw(const PictureConfig& p, const RunResults& results, const Sheet& sheet, const fs::path& directory,
            std::vector<fs::path>& made) const {
    const fs::path png = directory / (file_name(p) + ".png");
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
      case Motif::load_curve:
      case Motif::strains: {
        if (results.curves.empty()) throw UserError("there is no curves.csv");
        const CurvesFile curves(results.curves);
        const Chart chart = p.show == Motif::strains      ? strains_chart(curves, config_.columns)
                            : p.show == Motif::load_curve ? load_chart(curves, config_.columns)
                                                          : stress_strain_chart(curves, config_.columns);
        write_chart(chart, sheet, directory / file_name(p), made);
        return;
      }
      case Motif::tables:
        return draw_tables(results.tables, sheet, directory, made);
    }
    made.push_back(png);
  }

  /// Tables of another shape are for other programs. One that is damaged does not keep the others from being drawn.
  void draw_tables(const std::vector<fs::path>& tables, const Sheet& sheet, const fs::path& directory,
                   std::vector<fs::path>& made) const {
    std::string problems;
    for (const fs::path& file : tables) {
      const std::string name = file.stem().string();
      try {
        for (const PictureConfig& p : config_.pictures.value_or(std::vector<PictureConfig>{}))
          if (file_name(p) == name) throw UserError("another picture has the name of the table " + name);
        const CurvesFile table(file);
        if (is_rose(table)) write_rose(rose_of(table, name), sheet, directory / name, made);
        else if (is_histogram(table)) write_chart(histogram_chart(table, name), sheet, directory / name, made);
        else if (is_profile(table)) write_chart(profile_chart(table, name), sheet, directory / name, made);
      } catch (const UserError& e) { problems.append(problems.empty() ? "" : "; ").append(name + ": " + e.what()); }
    }
    if (!problems.empty()) throw UserError(problems);
  }

  Config config_;
};

}  // namespace breccia

BRECCIA_PLUGIN(breccia::Pictures, "renderer", "pictures")
