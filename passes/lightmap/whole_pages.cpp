#include "passes/lightmap/whole_pages.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace wrlkit::bake {
namespace {

using unwrap::Atlas;
using unwrap::PackedItem;
using unwrap::PackItem;
using unwrap::PackOptions;
using unwrap::Placement;

bool is_whole(const PackedItem& item) {
  return !item.crowded &&
         std::ranges::all_of(item.charts, [&](const Placement& c) { return c.page == item.charts[0].page; });
}

int larger(const PackOptions& options) {
  constexpr int most_side = 32768;
  if (options.side >= most_side) throw std::length_error("a surface has more charts than the largest page has texels");
  return options.side ? 2 * options.side : options.max_side;
}

Atlas joined(Atlas a, Atlas b) {
  const auto first = static_cast<std::uint32_t>(a.pages.size());
  for (PackedItem& item : b.items)
    for (auto* places : {&item.charts, &item.copies})
      for (Placement& c : *places) c.page += first;
  std::ranges::move(b.pages, std::back_inserter(a.pages));
  std::ranges::move(b.items, std::back_inserter(a.items));
  a.factor = b.factor;
  return a;
}

}  // namespace

Atlas pack_whole(std::span<const PackItem> items, const PackOptions& options) {
  Atlas atlas = unwrap::pack(items, options);
  if (std::ranges::all_of(atlas.items, is_whole)) return atlas;
  if (items.size() == 1) {
    const int side = larger(options);
    return pack_whole(items, {options.padding, std::max(options.max_side, side), side});
  }
  const std::size_t middle = items.size() / 2;
  return joined(pack_whole(items.first(middle), options), pack_whole(items.subspan(middle), options));
}

}  // namespace wrlkit::bake
