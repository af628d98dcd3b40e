// SPDX-License-Identifier: BSD-3-Clause
#include "run/packing_cache.hpp"

#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <optional>
#include <random>
#include <system_error>
#include <thread>

#include "breccia/atomic_file.hpp"
#include "breccia/text_file.hpp"
#include "config/places.hpp"
#include "engine/meeting_parts.hpp"
#include "hash/sha256.hpp"
#include "plugin/guarded.hpp"
#include "results/file_lock.hpp"
#include "run/run_ranks.hpp"
#include "run/warning_log.hpp"

namespace breccia {
namespace {

namespace fs = std::filesystem;

/// For the hash alone. A name in a configuration need not be UTF-8, which JSON's text must be.
std::string key_text(const Json& key) {
  if (is_utf8(key)) return key.dump();
  const std::vector<std::uint8_t> bytes = Json::to_cbor(key);
  return {bytes.begin(), bytes.end()};
}

Json to_json(const PackedParticles& p) {
  Json j;
  std::vector<double> flat;
  for (std::size_t k = 0; k < p.position.size(); ++k)
    flat.insert(flat.end(), {p.position[k].x(), p.position[k].y(), p.position[k].z(), p.radius[k]});
  j["particles"] = std::move(flat);
  j["outline"] = int(p.outline);
  j["axis"] = {p.axis.x(), p.axis.y(), p.axis.z()};
  j["container_volume"] = p.container_volume;
  j["period"] = {p.period.x(), p.period.y(), p.period.z()};
  for (const auto& [name, values] : p.columns) j["columns"].push_back({{"name", name}, {"values", values}});
  for (const AskedGot& line : p.report)
    j["report"].push_back({{"name", line.name},
                           {"unit", line.unit},
                           {"asked", line.asked ? Json(*line.asked) : Json()},
                           {"got", line.got}});
  return j;
}

PackedParticles from_json(const Json& j) {
  PackedParticles p;
  const auto flat = j.at("particles").get<std::vector<double>>();
  if (flat.empty() || flat.size() % 4) throw std::runtime_error("wrong length");
  for (std::size_t k = 0; k < flat.size(); k += 4) {
    p.position.emplace_back(flat[k], flat[k + 1], flat[k + 2]);
    p.radius.push_back(flat[k + 3]);
  }
  p.outline = static_cast<SpecimenShape::Outline>(j.at("outline").get<int>());
  for (int k = 0; k < 3; ++k) p.axis[k] = j.at("axis").at(std::size_t(k)).get<double>();
  p.container_volume = j.at("container_volume").get<double>();
  for (int k = 0; k < 3; ++k) p.period[k] = j.at("period").at(std::size_t(k)).get<double>();
  if (j.contains("columns"))
    for (const Json& c : j.at("columns"))
      p.columns.emplace_back(c.at("name").get<std::string>(), c.at("values").get<std::vector<double>>());
  if (j.contains("report"))
    for (const Json& line : j.at("report"))
      p.report.push_back({line.at("name").get<std::string>(), line.at("unit").get<std::string>(),
                          line.at("asked").is_null() ? std::nullopt : std::optional(line.at("asked").get<double>()),
                          line.at("got").get<double>()});
  return p;
}

/// Of what the ranks have, one behind the other.
std::string content_hash(const PackedParticles& p, const RunRanks& ranks) {
  constexpr std::size_t at_once = 4096;
  return ranks
      .one_after_the_other(
          Sha256(),
          [&](Sha256& hash) {
            std::vector<double> flat;
            for (std::size_t k = 0; k < p.position.size(); ++k) {
              flat.insert(flat.end(), {p.position[k].x(), p.position[k].y(), p.position[k].z(), p.radius[k]});
              if (flat.size() < 4 * at_once && k + 1 < p.position.size()) continue;
              hash.add(std::as_bytes(std::span(flat)));
              flat.clear();
            }
          })
      .hex();
}

/// CBOR keeps every bit of a number and is quick; the hash of the body in front tells a damaged file.
std::optional<PackedParticles> read_cached(const fs::path& file, Host& host) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) return std::nullopt;
  if (status.type() != fs::file_type::regular) {  // reading a pipe would wait for ever
    host.warn("the cached packing " + file.string() + " cannot be read (" +
              (error ? error.message() : "it is no file") + "): the packing is made anew");
    return std::nullopt;
  }
  try {
    const std::string all = read_bytes(file);
    if (all.size() < 64 || all.substr(0, 64) != sha256(all.substr(64))) throw std::runtime_error("damaged");
    const Json body = Json::from_cbor(all.substr(64));
    PackedParticles particles = from_json(body);
    if (const auto said = body.find("warnings"); said != body.end())  // they hold for every run with this packing
      for (const Json& text : *said) host.warn(text.get<std::string>());
    return particles;
  } catch (const UserError& e) {
    host.warn(std::string(e.what()) + ": the packing is made anew");
    return std::nullopt;
  } catch (const std::exception&) {
    host.warn("the cached packing " + file.string() + " is damaged and is made anew");
    return std::nullopt;
  }
}

void write_cached(const fs::path& file, const PackedParticles& p, const std::vector<std::string>& warnings,
                  Host& host) {
  // Under a name of its own first: other processes may be writing the same packing.
  const fs::path own = file.string() + "." + std::to_string(std::random_device()()) + std::to_string(getpid());
  try {
    std::error_code error;
    fs::create_directories(file.parent_path(), error);
    if (error) throw UserError("cannot make the folder " + file.parent_path().string() + ": " + error.message());
    Json all = to_json(p);
    if (!warnings.empty()) all["warnings"] = warnings;
    const std::vector<std::uint8_t> body = Json::to_cbor(all);
    const std::string text(body.begin(), body.end());
    write_file(own, sha256(text) + text);
    fs::rename(own, file, error);
    if (error) throw UserError("cannot write " + file.string() + ": " + error.message());
  } catch (const std::exception& e) {
    std::error_code ignored;
    fs::remove(own, ignored);
    host.warn(std::string("the packing was not kept for the next run: ") + e.what());
  }
}

/// Held while a packing is made, so that other processes which want the same wait and read it. Without locks in the
/// file system, and where the folder cannot be written to, each makes its own.
std::optional<FileLock> turn_for(const fs::path& file, Host& host) {
  const fs::path name = file.string() + ".lock";
  std::error_code ignored;
  fs::create_directories(name.parent_path(), ignored);
  for (bool told = false;; told = true) {
    try {
      FileLock lock(name);
      if (lock.state() != FileLock::State::with_another) return lock;
    } catch (const std::system_error&) { return {}; }
    if (host.cancelled()) throw Cancelled();
    if (!told) host.info("another process is making the same packing: waiting for it");
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

}  // namespace

fs::path default_cache_folder() {
  if (const char* own = std::getenv("BRECCIA_CACHE"); own && *own) return own;
  if (const char* xdg = std::getenv("XDG_CACHE_HOME"); xdg && *xdg) return fs::path(xdg) / "breccia";
  if (const char* home = std::getenv("HOME"); home && *home) return fs::path(home) / ".cache" / "breccia";
  return {};
}

void refuse_what_cannot_be(const Packing& packing, const std::string& type, const PackingRequest& request) {
  const std::string why =
      calling({Packing::kind, type}, "looking at what is asked for", [&] { return packing.why_not(request); });
  if (!why.empty()) throw AtPath("packing", "packing " + type + ": " + why);
  if (request.repeats() && !packing.can_repeat())
    throw AtPath("packing", "packing " + type + ": it cannot fill a space that repeats itself (`periodic`)");
}

namespace {

/// By one process: from the cache, where it is there.
void make_or_read(Packing& packing, const Registry& registry, const PluginChoice& choice, const PackingRequest& request,
                  const fs::path& cache_folder, Host& host, PackingOutcome& outcome) {
  const PluginId id{Packing::kind, choice.type};
  const auto make = [&](Host& to) {
    calling(id, "making the packing", [&] { outcome.particles = packing.generate(request, to); });
  };
  if (cache_folder.empty()) return make(host);
  Json key = {{"plugin", registry.info(Packing::kind, choice.type).sha256()},
              {"type", choice.type},
              {"config", choice.config},
              {"seed", request.seed},
              {"dimension", request.dimension},
              {"thickness", request.thickness}};
  if (request.repeats()) key["periodic"] = request.periodic;
  for (const fs::path& input : calling(id, "naming its files", [&] { return packing.inputs(); }))
    key["inputs"].push_back(sha256(read_bytes(input)));
  const fs::path file = cache_folder / "packings" / (sha256(key_text(key)) + ".cbor");
  const auto look = [&] {
    if (auto cached = read_cached(file, host)) {
      outcome.particles = std::move(*cached);
      outcome.from_cache = true;
    }
  };
  look();
  std::optional<FileLock> turn;
  if (!outcome.from_cache) {
    if (auto now = turn_for(file, host)) turn.emplace(std::move(*now));
    look();  // it may have been made meanwhile
  }
  if (outcome.from_cache) return;
  WarningLog<Host> log(host);
  make(log);
  const std::size_t count = outcome.particles.radius.size();
  // What may be made in shares is made as quickly as it would be read: large ones need no place on the disk.
  if (count > 0 && (count <= 1000000 || !packing.makes_shares()))
    write_cached(file, outcome.particles, log.warnings(), host);
}

}  // namespace

PackingOutcome obtain_packing(const Registry& registry, const PluginChoice& choice, const PackingRequest& asked,
                              const fs::path& cache_folder, Host& host, RankLink* link) {
  const RunRanks ranks(link);
  const auto packing = registry.create<Packing>(choice);
  refuse_what_cannot_be(*packing, choice.type, asked);
  PackingOutcome outcome;
  PackedParticles& particles = outcome.particles;
  MeetingParts others(link);
  outcome.in_pieces = ranks.several() && packing->makes_shares();
  others.together([&] {
    PackingRequest request = asked;
    if (outcome.in_pieces) request.share.part = {&others, {}, {}, {}, link->rank(), link->ranks()};
    if (outcome.in_pieces || ranks.first())
      make_or_read(*packing, registry, choice, request, outcome.in_pieces ? fs::path() : cache_folder, host, outcome);
    for (std::size_t k = 0; k < 3 && (outcome.in_pieces || ranks.first()); ++k)
      if (request.periodic[k] != (particles.period[int(k)] > 0))
        throw UserError("packing " + choice.type + ": it does not repeat itself along the directions of `periodic`");
  });
  outcome.count = std::size_t(ranks.sum(std::int64_t(particles.radius.size())));
  outcome.hash = content_hash(particles, ranks);
  return outcome;
}

}  // namespace breccia
