#include "tools/corpus/journal.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/text/json.h"
#include "base/text/json_reader.h"

namespace wrlkit {
namespace {

constexpr std::string_view states[] = {"made", "made-partly", "failed", "crashed", "timeout", "no-memory"};

}  // namespace

std::string_view to_string(JobState s) { return states[static_cast<int>(s)]; }

std::string to_json(const JournalLine& l) { return json_of(l); }

std::optional<JournalLine> journal_line(std::string_view text) {
  JsonDocument doc;
  if (doc.parse(text)) return std::nullopt;
  const auto json = doc.root();
  JournalLine l;
  auto word = [&](std::string_view key) { return std::string(json[key].text()); };
  auto whole = [&](std::string_view key) { return json[key].whole().value_or(0); };
  const auto state = std::ranges::find(states, json["state"].text());
  if (!json.is_object() || state == std::end(states)) return std::nullopt;
  l.state = static_cast<JobState>(state - std::begin(states));
  l.input = word("input");
  l.output = word("output");
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
    l.files.push_back({std::string(f["referrer"].text()), std::string(f["url"].text()), std::string(f["path"].text()),
                       hash_from(f["hash"].text())});
  l.messages = json["messages"].source();
  return l;
}

std::string name_in_journal(const std::string& name) {
  if (std::ranges::all_of(name, [](char c) { return static_cast<unsigned char>(c) < 0x80; })) return name;
  JournalLine line;
  line.output = name;
  return journal_line(to_json(line))->output;
}

std::optional<Journal> Journal::open(const std::string& folder, Shard shard, std::string& why) {
  auto lines = LineJournal::open(fmt::format("{}/journal-{}-of-{}.jsonl", folder, shard.index + 1, shard.count), why);
  if (!lines) return std::nullopt;
  return Journal(std::move(*lines));
}

bool Journal::append(const JournalLine& l) { return lines_.append(to_json(l)); }

void Journal::settle() { lines_.settle(); }

void read_journals(const std::string& folder, const std::function<void(JournalLine&&)>& take) {
  read_journal_lines(folder, [&](const std::string& text) {
    if (auto l = journal_line(text)) take(std::move(*l));
  });
}

std::string corpus_folder(const std::string& out) { return out + "/.wrlkit"; }

}  // namespace wrlkit
