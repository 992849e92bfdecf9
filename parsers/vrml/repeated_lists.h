// Lists of numbers that a file writes again, letter for letter, as exporters do for every bolt. They are read once, and
// their arrays are in memory once.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "base/arena.h"

namespace wrlkit::vrml {

class RepeatedLists {
 public:
  static constexpr std::size_t shortest = 64;  // bytes; reading less costs as much as looking it up

  /// The id of a list of the same text and kind of numbers that was added before; otherwise `id`, which is that of this
  /// one from now on, unless others have its hash, or there are too many short ones already. The texts of long ones
  /// have to live as long. O(bytes), and O(1) for long ones where nothing is like it.
  std::uint32_t find_or_add(std::string_view list, bool real, std::uint32_t id);

 private:
  struct List {
    std::uint64_t hash = 0;
    const char* text = nullptr;  // null: a free place
    std::uint32_t size = 0, id = 0;
  };
  List& place_of(std::uint64_t hash);
  void grow();

  std::vector<List> lists_ = std::vector<List>(256);  // open addressing, a power of two
  std::size_t n_lists_ = 0;
  // Short lists are compared with copies, for these lie together: what a file said long ago is in no cache.
  Arena copies_;
  std::size_t copied_ = 0;  // bytes
};

}  // namespace wrlkit::vrml
