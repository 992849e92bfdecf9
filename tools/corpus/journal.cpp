#include "tools/corpus/journal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>

#include "base/text/json.h"
#include "base/text/json_reader.h"

namespace wrlkit {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view states[] = {"made", "made-partly", "failed", "crashed", "timeout", "no-memory"};

bool lock(int fd) {
  // Workers of a run that was killed a moment ago hold it until they are gone, too.
  for (int i = 0; i < 50; ++i, usleep(100'000))
    if (flock(fd, LOCK_EX | LOCK_NB) == 0) return true;
  return false;
}

/// A line that was cut off stays what it is, and the next one begins on a line of its own.
void end_cut_line(int fd) {
  const auto size = lseek(fd, 0, SEEK_END);
  char last = '\n';
  if (size > 0 && pread(fd, &last, 1, size - 1) == 1 && last != '\n' && write(fd, "\n", 1) != 1) return;
}

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
  std::error_code fault;
  fs::create_directories(folder, fault);
  const auto path = fmt::format("{}/journal-{}-of-{}.jsonl", folder, shard.index + 1, shard.count);
  const int fd = ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (fd < 0 && fault) {
    why = folder + ": " + fault.message();
    return std::nullopt;
  }
  if (fd < 0) {
    why = path + ": " + std::strerror(errno);
    return std::nullopt;
  }
  Journal journal(fd);
  if (!lock(fd)) {
    why = path + ": another run is writing it";
    return std::nullopt;
  }
  end_cut_line(fd);
  return journal;
}

Journal::Journal(Journal&& o) noexcept : fd_(std::exchange(o.fd_, -1)) {}

Journal::~Journal() {
  if (fd_ >= 0) {
    settle();
    close(fd_);
  }
}

bool Journal::append(const JournalLine& l) {
  const auto text = to_json(l) + '\n';
  const auto n = write(fd_, text.data(), text.size());
  if (n >= 0 && n < static_cast<ssize_t>(text.size())) errno = ENOSPC;  // the half line is none
  return n == static_cast<ssize_t>(text.size());
}

void Journal::settle() { fdatasync(fd_); }

void read_journals(const std::string& folder, const std::function<void(JournalLine&&)>& take) {
  std::vector<fs::path> paths;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none)) {
    const auto name = entry.path().filename().string();
    if (name.starts_with("journal-") && name.ends_with(".jsonl")) paths.push_back(entry.path());
  }
  // The journal that was written last has the last word.
  std::ranges::sort(paths, {}, [&](const fs::path& p) { return std::pair(fs::last_write_time(p, none), p); });
  for (const auto& path : paths) {
    std::ifstream in(path);
    for (std::string text; std::getline(in, text);)
      if (auto l = journal_line(text)) take(std::move(*l));
  }
}

std::string corpus_folder(const std::string& out) { return out + "/.wrlkit"; }

}  // namespace wrlkit
