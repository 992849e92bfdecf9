// What has become of one scene: how far its surface has moved, and how it looked before and after. Kept by contents, so
// that a report that is made again has it.
#pragma once
#include <optional>
#include <string>

#include "tools/cli/flags.h"
#include "tools/corpus/journal.h"

namespace wrlkit {

struct Look {
  double rms = 0, max = 0, of_diagonal = 0;  // metres; not finite: one of the scenes has no surface
  std::string before, after;                 // JPEG pictures as base64; empty: none could be drawn
};

/// Where the look at what a line of a journal tells of is kept.
std::string look_file(const std::string& out, const JournalLine& line);
/// Reads both scenes, measures, draws, and writes that file; `flags`: of the conversion. False when one cannot be read.
bool make_look(const Flags& flags, const std::string& out, const JournalLine& line);
/// What was written there; nothing when nothing was.
std::optional<Look> read_look(const std::string& path);

}  // namespace wrlkit
