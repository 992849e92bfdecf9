// Lists of numbers that a file writes again, letter for letter, as exporters do for every bolt. They are read once, and
// their arrays are in memory once.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <unordered_map>

namespace wrlkit::vrml {

class RepeatedLists {
 public:
  static constexpr std::size_t shortest = 64;  // bytes; reading less costs as much as looking it up

  /// The id of a list of the same text and kind of numbers that was added before; otherwise `id`, which is that of this
  /// one from now on, unless others have its hash. The texts have to live as long. O(bytes), and O(1) where nothing is
  /// like it.
  std::uint32_t find_or_add(std::string_view list, bool real, std::uint32_t id);

 private:
  struct List {
    std::string_view text;
    std::uint32_t id;
  };
  std::unordered_map<std::uint64_t, List> lists_;
};

}  // namespace wrlkit::vrml
