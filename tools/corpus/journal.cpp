#include "tools/corpus/journal.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/io/uri.h"
#include "base/text/json.h"
#include "base/text/json_reader.h"
#include "base/text/utf8.h"

namespace wrlkit {
namespace {

constexpr std::string_view escaped_name = "bytes:";
constexpr std::string_view begun_kind = "begun";
constexpr std::string_view states[] = {"made", "made-partly", "failed", "crashed", "timeout", "no-memory"};

}  // namespace

std::string_view to_string(JobState s) { return states[static_cast<int>(s)]; }

std::string name_to_json(const std::string& name) {
  if (is_utf8(name) && !name.starts_with(escaped_name)) return name;
  return std::string(escaped_name) + uri_of(name);
}

std::string name_from_json(std::string_view text) {
  return text.starts_with(escaped_name) ? percent_decode(text.substr(escaped_name.size())) : std::string(text);
}

std::string to_json(const JournalLine& l) { return json_of(l); }

std::optional<JournalLine> journal_line(std::string_view text) {
  JsonDocument doc;
  if (doc.parse(text)) return std::nullopt;
  const auto json = doc.root();
  JournalLine l;
  const auto name = [](Json text) { return name_from_json(text.text()); };
  auto word = [&](std::string_view key) { return std::string(json[key].text()); };
  auto whole = [&](std::string_view key) { return json[key].whole().value_or(0); };
  const auto state = std::ranges::find(states, json["state"].text());
  if (!json.is_object() || state == std::end(states)) return std::nullopt;
  l.state = static_cast<JobState>(state - std::begin(states));
  l.input = name(json["input"]);
  l.output = name(json["output"]);
  l.cause = word("cause");
  l.work = hash_from(json["work"].text());
  l.input_hash = hash_from(json["input_hash"].text());
  l.output_hash = hash_from(json["output_hash"].text());
  l.started = json["started"].number();
  l.seconds = json["seconds"].number();
  l.cpu = json["cpu"].number();
  l.memory = whole("memory");
  l.input_bytes = whole("input_bytes");
  l.output_bytes = whole("output_bytes");
  l.codecs = json["codecs"].boolean();
  for (auto f : json["files"])
    l.files.push_back({name(f["referrer"]), name(f["url"]), name(f["path"]), hash_from(f["hash"].text())});
  for (auto f : json["companions"]) l.companions.push_back({name(f["path"]), f["bytes"].whole().value_or(0)});
  l.messages = json["messages"].source();
  return l;
}

std::optional<Journal> Journal::open(const std::string& folder, Shard shard, std::string& why) {
  const auto open_lines = [&](std::string_view kind) {
    return LineJournal::open(fmt::format("{}/{}-{}-of-{}.jsonl", folder, kind, shard.index + 1, shard.count), why);
  };
  auto lines = open_lines("journal");
  auto begun = lines ? open_lines(begun_kind) : std::nullopt;
  if (!begun) return std::nullopt;
  return Journal(std::move(*lines), std::move(*begun));
}

bool Journal::append(const JournalLine& l) { return lines_.append(to_json(l)); }

bool Journal::append_begun(const std::string& output) {
  return begun_.append(json_of(json_object("output", name_to_json(output))));
}

void Journal::settle() { lines_.settle(); }

std::size_t read_journals(const std::string& folder, const std::function<void(JournalLine&&)>& take) {
  std::size_t n_damaged = 0;
  read_journal_lines(folder, [&](const std::string& text) {
    auto line = journal_line(text);
    n_damaged += !line;
    if (line) take(std::move(*line));
  });
  return n_damaged;
}

void read_begun(const std::string& folder, const std::function<void(std::string&&)>& take) {
  const auto take_line = [&](const std::string& text) {
    JsonDocument doc;
    if (!doc.parse(text)) take(name_from_json(doc.root()["output"].text()));
  };
  read_journal_lines(folder, take_line, begun_kind);
}

std::string corpus_folder(const std::string& out) { return out + "/.wrlkit"; }

}  // namespace wrlkit
