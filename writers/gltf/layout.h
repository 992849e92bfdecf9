// How the binary part of a glTF file is laid out: the views of the Store one after another, then pictures, each at a
// multiple of four bytes. Views may be packed by meshoptimizer; what they are unpacked into is a second buffer, which
// is in no file.
#pragma once
#include "writers/gltf/parts.h"
#include "writers/gltf/store.h"
#include "writers/gltf/textures.h"

namespace wrlkit::gltf {

class Layout {
 public:
  struct BufferView {
    std::uint64_t offset, length;
    View view;  // unless it is a picture
    std::uint32_t picture = none, blob = none, column = none;
    std::string packed;          // empty: it is not
    std::uint64_t unpacked = 0;  // bytes of a packed one; its place in the second buffer
    std::uint64_t unpacked_offset = 0;
    std::uint64_t padding = 0;  // zeros behind it
  };

  /// `blobs` become views of their own, behind those of the Store; then columns of a table, each at a multiple of eight
  /// bytes.
  Layout(const Store&, const std::vector<std::string>& blobs, const std::vector<Column>& columns,
         const std::vector<Picture>& inside, bool meshopt);

  const std::vector<BufferView>& views() const { return views_; }
  /// Index into views().
  std::uint32_t of(View v) const { return of_view_[static_cast<std::size_t>(v)]; }
  std::uint32_t of_blob(std::size_t i) const {
    return static_cast<std::uint32_t>(views_.size() - n_pictures_ - columns_.size() - blobs_.size() + i);
  }
  std::uint32_t of_column(std::size_t i) const {
    return static_cast<std::uint32_t>(views_.size() - n_pictures_ - columns_.size() + i);
  }
  std::uint32_t of_picture(std::size_t i) const { return static_cast<std::uint32_t>(views_.size() - n_pictures_ + i); }
  /// Bytes of the elements of a column of numbers; 0: two.
  std::uint8_t stride_of_column(std::size_t i) const { return columns_[i].stride; }
  bool pictures_inside() const { return n_pictures_ > 0; }
  std::uint64_t size() const { return size_; }
  /// The size of the second buffer; 0: nothing is packed.
  std::uint64_t unpacked_size() const { return unpacked_size_; }
  /// Without pictures.
  std::uint64_t geometry_size() const { return geometry_size_; }
  /// How many of these are of which kind.
  std::vector<std::pair<std::string_view, std::uint64_t>> shares() const;
  /// The bytes.
  void pieces(std::vector<std::string_view>& out, bool with_pictures = true) const;

 private:
  void add(BufferView, std::uint64_t alignment = 4);

  const Store& store_;
  const std::vector<std::string>& blobs_;
  const std::vector<Column>& columns_;
  const std::vector<Picture>& pictures_;
  std::size_t n_pictures_;
  std::array<std::uint32_t, n_views> of_view_;
  std::vector<BufferView> views_;
  std::uint64_t size_ = 0, unpacked_size_ = 0, geometry_size_ = 0;
};

}  // namespace wrlkit::gltf
