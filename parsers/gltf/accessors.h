// Accessors as numbers: any component type, interleaved, strided, sparse, normalised; every offset and count checked.
// Single precision numbers become the double of their shortest decimal text, so that 0.1f is 0.1 again.
#pragma once
#include "parsers/gltf/buffers.h"

namespace wrlkit::gltf_reader {

/// The number that a float was printed as, with the fewest digits.
double finite_decimal(float);

struct Numbers {
  std::size_t width = 0;  // 1, 2, 3, 4, 16
  std::vector<double> values;
  std::size_t count() const { return width ? values.size() / width : 0; }
  const double* at(std::size_t i) const { return values.data() + i * width; }
};

class Accessors {
 public:
  /// The limit for accessors without data, which are all zero: a few bytes can claim any number of them.
  static constexpr std::uint64_t max_zeros = 50'000'000;

  Accessors(File& file, Buffers& buffers) : file_(file), buffers_(buffers) {}

  /// `widths`: those that the use allows. Nothing when it cannot be read, which was reported.
  std::optional<Numbers> numbers(std::uint32_t index, std::initializer_list<std::size_t> widths);
  /// Whole numbers: indices and joints, `width` for each element.
  std::optional<std::vector<std::uint32_t>> whole(std::uint32_t index, std::size_t width = 1);
  std::uint64_t count(std::uint32_t index) const {
    return file_.at(Table::accessors, index)["count"].whole().value_or(0);
  }

 private:
  struct Layout {
    std::size_t count = 0, width = 0, size = 0;  // of one component
    int component = 0;
    bool normalized = false;
    std::size_t element() const { return width * size; }
  };
  std::optional<Layout> layout(std::uint32_t index);
  /// The bytes of `count` elements of `size`, and their stride.
  std::optional<ViewBytes> place(Json of, std::size_t count, std::size_t size);
  template <class T, class Convert>
  bool read(std::uint32_t index, const Layout&, std::vector<T>& out, Convert);
  template <class T, class Convert>
  bool sparse(Json, const Layout&, std::vector<T>& out, Convert);
  bool fails(std::uint32_t index, std::string_view why);

  File& file_;
  Buffers& buffers_;
  std::uint64_t zeros_ = 0;
};

}  // namespace wrlkit::gltf_reader
