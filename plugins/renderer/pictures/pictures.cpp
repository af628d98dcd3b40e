// SPDX-License-Identifier: BSD-3-Clause
/// Pictures of a finished run, drawn from its files on any machine: no display, no graphics card.
#include <vtkCellData.h>
#include <vtkPointData.h>

#include <algorithm>

#include "breccia/atomic_file.hpp"
#include "breccia/renderer.hpp"
#include "chart_pictures.hpp"
#include "comparison.hpp"
#include "cracks.hpp"
#include "field_histogram.hpp"
#include "frames.hpp"
#include "picture_config.hpp"
#include "strength_chart.hpp"
#include "table_pictures.hpp"

namespace breccia {
namespace fs = std::filesystem;
using namespace pictures;

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
            "Reads `particles.pvd`, `bonds.pvd` and `curves.csv` of a result folder, or one .pvd, .vtp or .pvtp file, "
            "and "
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
            "dimensions), `displacement_across` (discs, tension, bending), `cracks` if there are any, `load_curve`, "
            "and "
            "`stress_strain` unless the load is not axial; of tables alone `tables`");
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
        .fallback({{"damage", "global_damage"}, {"lateral_strain", "lateral_strain"}, {"load", "load"}})
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
      for (const PictureConfig& p : c.pictures.value_or(std::vector<PictureConfig>{})) {
        p.check("pictures[" + std::to_string(pictures.size()) + "]", issues);
        pictures.push_back(p.file_name());
      }
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

    Frames frames(results);
    const std::vector<PictureConfig> pictures = config_.pictures ? *config_.pictures : usual_pictures(results, frames);
    const Sheet sheet{int(config_.size), config_.background, host.threads()};
    std::vector<fs::path> made;
    std::string last_problem = "the run has none of the data they need";
    for (std::size_t k = 0; k < pictures.size(); ++k) {
      if (host.cancelled()) throw Cancelled();
      host.progress("pictures", double(k) / double(pictures.size()));
      const PictureConfig& picture = pictures[k];
      try {
        if (picture.movie) draw_movie(picture, frames, sheet, request.directory, host, made);
        else draw(picture, results, frames, sheet, request.directory, made);
      } catch (const CannotWrite&) { throw; } catch (const UserError& e) {
        last_problem = "picture `" + picture.file_name() + "` was not made: " + e.what();
        host.warn(last_problem);
      } catch (const Unavailable& e) {
        last_problem = "movie `" + picture.file_name() + "` was not made: " + e.what();
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

  /// What a run of any kind can show, without a word about what it is not made to show.
  std::vector<PictureConfig> usual_pictures(const RunResults& results, Frames& frames) const {
    std::vector<PictureConfig> usual;
    const auto add = [&](Motif show) { usual.emplace_back().show = show; };
    if (!results.particle_frames.empty()) {
      const TestSetup& setup = frames.setup();
      add(Motif::specimen);
      if (setup.dimension == 3 && setup.held.empty()) add(Motif::cutaway);
      if (!setup.across.isZero()) add(Motif::displacement_across);
    }
    if (!results.bond_frames.empty() && has_broken_bonds(frames.at({}, true, true).bonds)) add(Motif::cracks);
    if (!results.curves.empty()) {
      const CurvesFile curves(results.curves);
      const bool load = has_load(curves, config_.columns);
      if (load) add(Motif::load_curve);
      // A disc on its edge has means along its axis, too, which say nothing.
      if (has_stress_strain(curves, config_.columns) && (!load || curves.find_role({role::machine_strain})))
        add(Motif::stress_strain);
    }
    if (usual.empty() && !results.tables.empty()) add(Motif::tables);
    return usual;
  }

  void draw(const PictureConfig& p, const RunResults& results, Frames& frames, const Sheet& sheet,
            const fs::path& directory, std::vector<fs::path>& made) const {
    if (p.is_scene()) {
      const SceneWish wish = p.wish();
      SceneFixed fixed;
      const SceneFrame frame = frames.at(p.frame, wish.cracks, wish.sees_through());
      made.push_back(directory / (p.file_name() + ".png"));
      try {
        write_scene(draw_scene(frame, wish, sheet, fixed), sheet, made.back());
      } catch (...) {
        made.pop_back();
        throw;
      }
      return;
    }
    if (p.show == Motif::tables) return draw_tables(results.tables, sheet, directory, made);
    Chart chart = p.show == Motif::histogram ? histogram(p, frames) : curve_chart(p, results);
    chart.title = p.title.value_or("");
    write_chart(chart, sheet, directory / p.file_name(), made);
  }

  Chart curve_chart(const PictureConfig& p, const RunResults& results) const {
    if (results.curves.empty()) throw UserError("there is no curves.csv");
    const CurvesFile curves(results.curves);
    return p.show == Motif::strains      ? strains_chart(curves, config_.columns)
           : p.show == Motif::load_curve ? load_chart(curves, config_.columns)
                                         : stress_strain_chart(curves, config_.columns);
  }

  /// Of a field of the particles, or else of the bonds.
  static Chart histogram(const PictureConfig& p, Frames& frames) {
    const std::string field = p.shown_field();
    const SceneFrame frame = frames.at(p.frame, frames.count(false) == 0, true);
    vtkFieldData* const particles = frame.particles ? frame.particles->GetPointData() : nullptr;
    vtkFieldData* const bonds = frame.bonds ? frame.bonds->GetCellData() : nullptr;
    const bool of_bonds = !particles || (bonds && !has_field(particles, field) && has_field(bonds, field));
    return field_histogram(field_of(of_bonds ? bonds : particles, field, frame.setup.dimension), p.bins);
  }

  /// All frames with one view and one range of colours: those of the last frame, and of the values of all.
  void draw_movie(const PictureConfig& p, Frames& frames, const Sheet& sheet, const fs::path& directory, Host& host,
                  std::vector<fs::path>& made) const {
    const SceneWish wish = p.wish();
    const fs::path file = directory / (p.file_name() + "." + ending_of(*p.movie));
    Movie movie(file, *p.movie, p.frames_per_second.value_or(10));
    const std::size_t count = frames.count(wish.cracks);
    SceneFixed fixed;
    fix_scene(frames.at({}, wish.cracks, wish.sees_through()), wish, sheet, fixed);
    for (std::size_t k = 0; k < count && !wish.cracks && fixed.scale; ++k)
      widen_scale(frames.at(long(k), false, false), wish, fixed);
    for (std::size_t k = 0; k < count; ++k) {
      if (host.cancelled()) throw Cancelled();
      movie.add(
          flat_scene(draw_scene(frames.at(long(k), wish.cracks, wish.sees_through()), wish, sheet, fixed), sheet));
    }
    movie.finish();
    made.push_back(file);
  }

  /// Tables of another shape are for other programs. One that is damaged does not keep the others from being drawn.
  void draw_tables(const std::vector<fs::path>& tables, const Sheet& sheet, const fs::path& directory,
                   std::vector<fs::path>& made) const {
    std::string problems;
    for (const fs::path& file : tables) {
      const std::string name = file.stem().string();
      try {
        for (const PictureConfig& p : config_.pictures.value_or(std::vector<PictureConfig>{}))
          if (p.file_name() == name) throw UserError("another picture has the name of the table " + name);
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
