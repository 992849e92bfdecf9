#include "python/pictures.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wrlkit::python {
namespace {

constexpr std::size_t head = 3;  // width, height, components
constexpr std::uint32_t byte = 0xff;
constexpr unsigned bits = 8;
constexpr std::int32_t most_components = 4;

/// All 0 where it has no pixels, or fewer than it says: writers show no such picture either.
struct Sides {
  std::size_t width = 0, height = 0, components = 0;
};

Sides sides_of(std::span<const std::int32_t> image) {
  if (image.size() < head || image[0] <= 0 || image[1] <= 0 || image[2] <= 0 || image[2] > most_components) return {};
  const auto width = static_cast<std::size_t>(image[0]), height = static_cast<std::size_t>(image[1]);
  if ((image.size() - head) / width < height) return {};
  return {width, height, static_cast<std::size_t>(image[2])};
}

void read_only(py::array& array) { array.attr("flags").attr("writeable") = false; }

}  // namespace

py::array picture(std::span<const std::int32_t> image) {
  const auto [width, height, components] = sides_of(image);
  py::array_t<std::uint8_t> out({height, width, components});
  auto* to = out.mutable_data();
  for (std::size_t y = height; y-- > 0;)
    for (std::size_t x = 0; x < width; ++x)
      for (auto c = components; c-- > 0;)
        *to++ = static_cast<std::uint8_t>(static_cast<std::uint32_t>(image[head + y * width + x]) >> (bits * c));
  read_only(out);
  return out;
}

py::list pictures(std::span<const std::int32_t> images) {
  py::list out;
  while (images.size() >= head) {
    const auto sides = sides_of(images);
    out.append(picture(images));
    images = images.subspan(head + sides.width * sides.height);
  }
  return out;
}

std::optional<std::vector<std::int32_t>> integers_of_picture(const py::object& value) {
  const auto given = py::array::ensure(value);
  if (!given || std::string_view("iu").find(given.dtype().kind()) == std::string_view::npos) return std::nullopt;
  const auto numbers = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>::ensure(given);
  const std::span<const std::int64_t> all(numbers.data(), static_cast<std::size_t>(numbers.size()));
  std::vector<std::int32_t> out;
  if (given.ndim() == 1) {
    const auto fits = [](std::int64_t v) {
      return v >= std::numeric_limits<std::int32_t>::min() && v <= std::numeric_limits<std::uint32_t>::max();
    };
    if (!std::ranges::all_of(all, fits)) return std::nullopt;
    for (const auto v : all) out.push_back(static_cast<std::int32_t>(static_cast<std::uint32_t>(v)));
    const bool has_sides = out.size() >= head && out[0] >= 0 && out[1] >= 0 && out[2] >= 0 && out[2] <= most_components;
    return has_sides && all[0] * all[1] == static_cast<std::int64_t>(all.size() - head) ? std::optional(out)
                                                                                        : std::nullopt;
  }
  if (given.ndim() != 2 && given.ndim() != 3) return std::nullopt;
  const auto height = given.shape(0), width = given.shape(1), components = given.ndim() == 3 ? given.shape(2) : 1;
  const auto is_byte = [](std::int64_t v) { return v >= 0 && v <= byte; };
  if (!std::ranges::all_of(all, is_byte)) return std::nullopt;
  if (all.empty()) return std::vector<std::int32_t>(head, 0);
  if (components > most_components || all.size() > std::numeric_limits<std::int32_t>::max()) return std::nullopt;
  out = {static_cast<std::int32_t>(width), static_cast<std::int32_t>(height), static_cast<std::int32_t>(components)};
  for (auto y = height; y-- > 0;)
    for (py::ssize_t x = 0; x < width; ++x) {
      std::uint32_t pixel = 0;
      for (py::ssize_t c = 0; c < components; ++c)
        pixel =
            pixel << bits | static_cast<std::uint32_t>(all[static_cast<std::size_t>((y * width + x) * components + c)]);
      out.push_back(static_cast<std::int32_t>(pixel));
    }
  return out;
}

std::optional<std::vector<std::int32_t>> integers_of_pictures(const py::object& value) {
  if (!py::isinstance<py::iterable>(value) || py::isinstance<py::str>(value)) return std::nullopt;
  std::vector<std::int32_t> out;
  for (auto item : value) {
    const auto one = integers_of_picture(py::reinterpret_borrow<py::object>(item));
    if (!one) return std::nullopt;
    out.insert(out.end(), one->begin(), one->end());
  }
  return out;
}

py::array truths(std::span<const std::int32_t> values) {
  py::array_t<bool> out(static_cast<py::ssize_t>(values.size()));
  std::ranges::transform(values, out.mutable_data(), [](std::int32_t v) { return v != 0; });
  read_only(out);
  return out;
}

}  // namespace wrlkit::python
