#include "writers/gltf/layout.h"

#include <map>

#include "writers/gltf/meshopt.h"

namespace wrlkit::gltf {
namespace {

constexpr std::uint64_t of_columns = 8;  // EXT_structural_metadata

std::uint64_t padding(std::uint64_t size, std::uint64_t alignment = 4) {
  return (alignment - size % alignment) % alignment;
}

std::string all_of(const Blocks& blocks) {
  std::string out(blocks.size(), '\0');
  blocks.copy(0, out.data(), out.size());
  return out;
}

std::string packed(View v, const Blocks& blocks) {
  const auto& type = info(v);
  const std::string bytes = all_of(blocks);
  if (!type.indices) return pack_elements(bytes, type.element);
  return v == View::index16 || v == View::index32 ? pack_triangles(bytes, type.element)
                                                  : pack_sequence(bytes, type.element);
}

}  // namespace

Layout::Layout(const Store& store, const std::vector<std::string>& blobs, const std::vector<Column>& columns,
               const std::vector<Picture>& inside, bool meshopt)
    : store_(store), blobs_(blobs), columns_(columns), pictures_(inside), n_pictures_(inside.size()) {
  of_view_.fill(none);
  for (std::size_t i = 0; i < n_views; ++i) {
    auto view = static_cast<View>(i);
    if (store.view(view).size() == 0) continue;
    of_view_[i] = static_cast<std::uint32_t>(views_.size());
    const auto size = store.view(view).size();
    if (!meshopt) {
      add({0, size, view});
      continue;
    }
    auto bytes = packed(view, store.view(view));
    const auto length = bytes.size();
    add({.offset = 0,
         .length = length,
         .view = view,
         .packed = std::move(bytes),
         .unpacked = size,
         .unpacked_offset = unpacked_size_});
    unpacked_size_ += size + padding(size);
  }
  for (std::size_t i = 0; i < blobs.size(); ++i)
    add({.offset = 0, .length = blobs[i].size(), .view = {}, .blob = static_cast<std::uint32_t>(i)});
  for (std::size_t i = 0; i < columns.size(); ++i) {
    BufferView v{.offset = 0, .length = columns[i].bytes.size(), .view = {}, .column = static_cast<std::uint32_t>(i)};
    if (meshopt && columns[i].stride > 0) {
      unpacked_size_ += padding(unpacked_size_, of_columns);
      v.packed = pack_elements(columns[i].bytes, columns[i].stride);
      v.length = v.packed.size();
      v.unpacked = columns[i].bytes.size();
      v.unpacked_offset = unpacked_size_;
      unpacked_size_ += v.unpacked + padding(v.unpacked);
    }
    add(std::move(v), of_columns);
  }
  geometry_size_ = size_;
  for (std::size_t i = 0; i < inside.size(); ++i)
    add({.offset = 0, .length = inside[i].bytes.size(), .view = {}, .picture = static_cast<std::uint32_t>(i)});
}

std::vector<std::pair<std::string_view, std::uint64_t>> Layout::shares() const {
  std::map<std::string_view, std::uint64_t> sums;
  for (const auto& v : views_)
    if (v.picture == none) sums[v.blob != none ? "draco" : v.column != none ? "names" : info(v.view).name] += v.length;
  return {sums.begin(), sums.end()};
}

void Layout::add(BufferView v, std::uint64_t alignment) {
  if (const auto more = padding(size_, alignment); more > 0 && !views_.empty()) {
    views_.back().padding += more;
    size_ += more;
  }
  v.offset = size_;
  v.padding = padding(v.length);
  size_ += v.length + v.padding;
  views_.push_back(std::move(v));
}

void Layout::pieces(std::vector<std::string_view>& out, bool with_pictures) const {
  constexpr std::string_view zeros("\0\0\0\0\0\0\0", of_columns - 1);
  for (const auto& v : views_) {
    if (v.picture != none && !with_pictures) continue;
    if (v.blob != none)
      out.push_back(blobs_[v.blob]);
    else if (v.unpacked > 0)
      out.push_back(v.packed);
    else if (v.column != none)
      out.push_back(columns_[v.column].bytes);
    else if (v.picture == none)
      store_.view(v.view).pieces(out);
    else
      out.push_back(pictures_[v.picture].bytes);
    if (v.padding > 0) out.push_back(zeros.substr(0, v.padding));
  }
}

}  // namespace wrlkit::gltf
