#include "writers/gltf_layout.h"

namespace wrlkit::gltf {
namespace {

constexpr std::uint64_t alignment = 4;

std::uint64_t padding(std::uint64_t size) { return (alignment - size % alignment) % alignment; }

}  // namespace

Layout::Layout(const Store& store, const std::vector<Picture>& inside)
    : store_(store), pictures_(inside), n_pictures_(inside.size()) {
  of_view_.fill(none);
  for (std::size_t i = 0; i < n_views; ++i) {
    auto view = static_cast<View>(i);
    if (store.view(view).size() == 0) continue;
    of_view_[i] = static_cast<std::uint32_t>(views_.size());
    add({0, store.view(view).size(), view});
  }
  for (std::size_t i = 0; i < inside.size(); ++i) add({0, inside[i].bytes.size(), {}, static_cast<std::uint32_t>(i)});
}

void Layout::add(BufferView v) {
  v.offset = size_;
  size_ += v.length + padding(v.length);
  views_.push_back(v);
}

void Layout::pieces(std::vector<std::string_view>& out) const {
  constexpr std::string_view zeros("\0\0\0", alignment - 1);
  for (const auto& v : views_) {
    if (v.picture == none)
      store_.view(v.view).pieces(out);
    else
      out.push_back(pictures_[v.picture].bytes);
    if (auto n = padding(v.length)) out.push_back(zeros.substr(0, n));
  }
}

}  // namespace wrlkit::gltf
