// The texts a scene was read from. A place in any of them is one 32-bit offset; file, line and column are computed only
// when a message is printed, from a text that is read again then.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace wrlkit {

/// Bytes [begin, begin + length) of the texts held by a Sources, counted over all of them.
struct Span {
  static constexpr std::uint32_t nowhere = 0xffffffffu;
  std::uint32_t begin = nowhere, length = 0;
  explicit operator bool() const { return begin != nowhere; }
};

struct Place {
  std::string_view file;
  std::size_t line = 0, column = 0;         // from 1; column counts bytes; 0: the file as a whole
  std::string line_text;                    // the line, cut to what can be shown
  std::size_t caret = 0, caret_length = 0;  // where the span is in line_text
};

class Sources {
 public:
  /// A text and what keeps it in memory.
  struct Loaded {
    std::string_view text;
    std::shared_ptr<const void> owner;
  };
  using Reload = std::function<Loaded()>;

  /// Registers a text of that size and returns the offset of its first byte; Span::nowhere when 4 GiB are exceeded.
  /// `reload` gives the text again when a message is printed; the last text is kept for the next message.
  std::uint32_t add(std::string name, std::size_t size, Reload reload, bool in_memory = false);
  /// Registers all texts of another one, once, and returns what is to be added to its offsets; Span::nowhere when 4 GiB
  /// are exceeded.
  std::uint32_t add_all(const std::shared_ptr<const Sources>& other);
  /// File, line, column and excerpt of a span. O(text).
  Place locate(Span) const;
  /// Name of the file that an offset lies in; empty when it lies in none.
  std::string_view file(std::uint32_t offset) const;
  /// Whether that is only a name: the text was given as bytes, which have no folder.
  bool is_in_memory(std::uint32_t offset) const;

 private:
  struct Source {
    std::string name;
    std::uint32_t begin, size;
    Reload reload;
    bool in_memory;
  };
  /// As many of the texts of another one as it had then.
  struct Added {
    std::shared_ptr<const Sources> from;
    std::size_t n;
    std::uint32_t shift;
  };
  const Source* find(std::uint32_t offset) const;
  std::uint64_t end() const {
    return sources_.empty() ? 0 : std::uint64_t{sources_.back().begin} + sources_.back().size + 1;
  }
  std::vector<Source> sources_;
  std::vector<Added> added_;
  mutable const Source* loaded_from_ = nullptr;
  mutable Loaded loaded_;
};

}  // namespace wrlkit
