// A progressive mesh as bytes (docs/progressive.md): the base, then the splits coarse to fine, so that any prefix
// behind the base is a coarser mesh. What the reader restores at the end is the original, bit for bit.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/progressive/progressive.h"

namespace wrlkit {

/// The bytes, and where they may be cut: behind the base first, then every few kilobytes behind a split, last at the
/// end.
struct ProgressiveStream {
  struct Cut {
    std::size_t end;
    float error;  // of the mesh up to there
  };
  std::string bytes;
  std::vector<Cut> cuts;
};

/// Takes a record that is complete, with all splits to the original. The smallest of the lossless ways to say the
/// positions is chosen. Positions between the base and the original are rounded to what can be said; those of the
/// original are exact, and must be finite. O(n).
ProgressiveStream write_progressive(const ProgressiveRecord& record);

struct ProgressiveRead {
  std::optional<ProgressiveRecord> record;  // nothing: see `error`
  bool complete = false;  // the original is there; otherwise the bytes end before, and the record with them
  std::string error;
};

/// Any bytes at all may come in. Time and memory are proportional to the bytes that are there, whatever they say:
/// typically ten bytes of memory for each, and never more than some two hundred.
ProgressiveRead read_progressive(std::string_view bytes);

}  // namespace wrlkit
