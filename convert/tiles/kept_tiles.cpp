#include "convert/tiles/kept_tiles.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <charconv>
#include <filesystem>
#include <unordered_set>

#include "base/io/file_lock.h"
#include "base/text/json.h"
#include "base/text/json_reader.h"
#include "convert/tiles/staging.h"

namespace wrlkit::tiles {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds patience(2);  // a run that was killed a moment ago may not be gone yet

std::string line_of(const std::string& key, const MadeTile& tile) {
  return json_text([&](JsonOut& json) {
    json.object([&] {
      json.member("tile", key);
      if (!tile.box.empty()) json.members("low", std::span(tile.box.low), "high", std::span(tile.box.high));
      json.members("rounding", tile.rounding, "hash", fmt::format("{:016x}", tile.hash), "triangles", tile.triangles,
                   "draws", tile.draws, "parts", tile.parts, "bytes", tile.bytes);
      if (tile.pieces_bytes) json.member("pieces", *tile.pieces_bytes);
      json.list("messages", tile.said, [&](const auto& said) {
        json.begin_array();
        json.value(info(said.id).name);
        for (const auto& arg : said.args) json.value(arg);
        json.end_array();
      });
    });
  });
}

Vec3 point_of(Json json) {
  Vec3 out{};
  std::size_t k = 0;
  for (const auto value : json)
    if (k < 3) out[k++] = value.number();
  return out;
}

std::vector<Said> said_of(Json json) {
  std::vector<Said> out;
  for (const auto message : json) {
    Said said{};
    bool is_first = true, known = false;
    for (const auto text : message) {
      if (is_first)
        known = find_diag(text.text(), said.id);
      else
        said.args.emplace_back(text.text());
      is_first = false;
    }
    if (known) out.push_back(std::move(said));
  }
  return out;
}

MadeTile tile_of(Json json) {
  MadeTile out;
  const auto whole = [&](std::string_view key) { return json[key].whole().value_or(0); };
  if (json["low"]) {
    out.box.low = point_of(json["low"]);
    out.box.high = point_of(json["high"]);
  }
  out.rounding = json["rounding"].number();
  const auto hash = json["hash"].text();
  std::from_chars(hash.data(), hash.data() + hash.size(), out.hash, 16);
  out.triangles = whole("triangles");
  out.draws = whole("draws");
  out.parts = whole("parts");
  out.bytes = whole("bytes");
  out.pieces_bytes = json["pieces"].whole();
  out.said = said_of(json["messages"]);
  return out;
}

bool has_size(const std::string& path, std::uint64_t bytes) {
  std::error_code fault;
  return fs::file_size(path, fault) == bytes && !fault;
}

}  // namespace

std::vector<Said> said_in(const Diagnostics& diag) {
  std::vector<Said> out;
  for (const auto& m : diag.messages()) out.push_back({m.id, m.args});
  return out;
}

void say(const std::vector<Said>& all, Diagnostics& to) {
  for (const auto& [id, a] : all) {
    if (a.size() == 1) to.report(id, {}, a[0]);
    if (a.size() == 2) to.report(id, {}, a[0], a[1]);
    if (a.size() == 3) to.report(id, {}, a[0], a[1], a[2]);
  }
}

bool KeptTiles::open(const std::string& folder, Shard shard, Diagnostics& diag) {
  folder_ = folder;
  std::error_code fault;
  fs::create_directories(folder_, fault);
  lock_ = ::open((folder_ + "/lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  std::string why;
  if (lock_ < 0)
    why = std::error_code(errno, std::generic_category()).message();
  else if (!lock_file(lock_, shard.count > 1 ? FileLock::shared : FileLock::exclusive, patience))
    why = "another run is at work there";
  else if (auto journal =
               LineJournal::open(fmt::format("{}/journal-{}-of-{}.jsonl", folder_, shard.index + 1, shard.count), why))
    journal_.emplace(std::move(*journal));
  if (journal_) read();
  if (!journal_) diag.report(Diag::cannot_write, {}, folder_, why);
  return journal_.has_value();
}

KeptTiles::~KeptTiles() {
  const bool is_mine = journal_.has_value();
  journal_.reset();
  if (is_mine && tiles_.empty() && lock_file(lock_, FileLock::exclusive)) forget();
  if (lock_ >= 0) close(lock_);
}

void KeptTiles::read() {
  read_journal_lines(folder_, [this](const std::string& text) { read_line(text); });
}

void KeptTiles::read_line(const std::string& text) {
  JsonDocument doc;
  if (doc.parse(text)) return;
  const auto json = doc.root();
  if (const auto of = json["error"]; of && json["metres"].is_number())
    errors_[std::string(of.text())] = json["metres"].number();
  else if (json["tile"])
    tiles_[std::string(json["tile"].text())] = tile_of(json);
}

bool KeptTiles::is_there(const ContentHash& key, const MadeTile& tile) const {
  if (tile.bytes > 0 && !has_size(tile_path(key), tile.bytes)) return false;
  return !tile.pieces_bytes || has_size(pieces_path(key), *tile.pieces_bytes);
}

const MadeTile* KeptTiles::find(const ContentHash& key) const {
  const auto at = tiles_.find(key.hex());
  return at != tiles_.end() && is_there(key, at->second) ? &at->second : nullptr;
}

std::optional<double> KeptTiles::error(const ContentHash& key) const {
  const auto at = errors_.find(key.hex());
  return at == errors_.end() ? std::nullopt : std::optional(at->second);
}

std::string KeptTiles::tile_path(const ContentHash& key) const { return folder_ + '/' + key.hex() + ".glb"; }

std::string KeptTiles::pieces_path(const ContentHash& key) const { return folder_ + '/' + key.hex() + ".pieces"; }

bool KeptTiles::save(const ContentHash& key, const MadeTile& tile) {
  const auto text = key.hex();
  tiles_[text] = tile;
  return journal_->append(line_of(text, tile));
}

bool KeptTiles::save_error(const ContentHash& key, double metres) {
  const auto text = key.hex();
  errors_[text] = metres;
  std::string line;
  JsonOut json(line);
  json.object("error", text, "metres", metres);
  return journal_->append(line);
}

bool KeptTiles::become_last() {
  // Of those that end at the same time the first to get the lock is the last.
  unlock_file(lock_);
  if (!lock_file(lock_, FileLock::exclusive)) return false;
  read();
  return true;
}

void KeptTiles::forget() {
  // Under another name at once: a run that is killed here leaves nothing to go on with, and the next one removes it.
  std::error_code none, fault;
  const auto aside = fs::path(folder_).parent_path() / (std::string(unfinished_folder) + "kept");
  fs::rename(folder_, aside, fault);
  fs::remove_all(fault ? fs::path(folder_) : aside, none);
  tiles_.clear();
  errors_.clear();
}

void KeptTiles::forget_others(const std::vector<ContentHash>& keys) {
  std::unordered_set<std::string> wanted;
  for (const auto& key : keys) wanted.insert(key.hex());
  std::error_code none;
  std::vector<fs::path> others;
  for (const auto& entry : fs::directory_iterator(folder_, none)) {
    const auto& path = entry.path();
    const bool is_kept = path.extension() == ".jsonl" || path.filename() == "lock";
    if (!is_kept && !wanted.contains(path.stem().string())) others.push_back(path);
  }
  for (const auto& path : others) fs::remove(path, none);
}

}  // namespace wrlkit::tiles
