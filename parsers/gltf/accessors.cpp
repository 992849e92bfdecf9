#include "parsers/gltf/accessors.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>

#include "base/math/digits.h"

namespace wrlkit::gltf_reader {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF data is read as it lies in the file");

enum Component {
  byte = 5120,
  unsigned_byte = 5121,
  short_ = 5122,
  unsigned_short = 5123,
  unsigned_int = 5125,
  float_ = 5126
};

std::size_t component_size(std::uint64_t type) {
  return type == byte || type == unsigned_byte      ? 1
         : type == short_ || type == unsigned_short ? 2
         : type == unsigned_int || type == float_   ? 4
                                                    : 0;
}

std::size_t width_of(std::string_view type) {
  return type == "SCALAR" ? 1 : type == "VEC2" ? 2 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : type == "MAT4" ? 16 : 0;
}

template <class T>
T raw(const char* p) {
  T v;
  std::memcpy(&v, p, sizeof v);
  return v;
}

double component(const char* p, int type, bool normalized) {
  switch (type) {
    case byte:
      return normalized ? finite_decimal(std::max(raw<std::int8_t>(p) / 127.0f, -1.0f)) : raw<std::int8_t>(p);
    case unsigned_byte:
      return normalized ? finite_decimal(raw<std::uint8_t>(p) / 255.0f) : raw<std::uint8_t>(p);
    case short_:
      return normalized ? finite_decimal(std::max(raw<std::int16_t>(p) / 32767.0f, -1.0f)) : raw<std::int16_t>(p);
    case unsigned_short:
      return normalized ? finite_decimal(raw<std::uint16_t>(p) / 65535.0f) : raw<std::uint16_t>(p);
    case unsigned_int:
      return raw<std::uint32_t>(p);
    default:
      return finite_decimal(raw<float>(p));
  }
}

std::uint32_t whole_component(const char* p, int type) {
  return type == unsigned_byte    ? raw<std::uint8_t>(p)
         : type == unsigned_short ? raw<std::uint16_t>(p)
                                  : raw<std::uint32_t>(p);
}

bool is_whole(int type) { return type == unsigned_byte || type == unsigned_short || type == unsigned_int; }

}  // namespace

// A number of tenths to millionths that is small enough for a float to tell it from its neighbours is the only one of
// as many places that reads as that float: if it does, it is the shortest, and neither product nor quotient has an
// error that counts. Everything else is written and read.
double finite_decimal(float f) {
  if (!std::isfinite(f)) return 0;
  for (const double per_one : {1e6, 1e5, 1e4, 1e3, 1e2, 1e1}) {
    constexpr double told_apart = (1 << 23) - 1;
    const double exact = f * per_one;
    if (std::abs(exact) >= told_apart) continue;
    const double nearest = static_cast<double>(static_cast<std::int64_t>(exact + std::copysign(0.5, exact))) / per_one;
    if (static_cast<float>(nearest) == f && nearest != 0) return nearest;
    break;
  }
  return decimal(f);
}

bool Accessors::fails(std::uint32_t index, std::string_view why) {
  file_.diag().report(Diag::gltf_no_data, file_.where(file_.at(Table::accessors, index)), word(Table::accessors), index,
                      why);
  return false;
}

std::optional<Accessors::Layout> Accessors::layout(std::uint32_t index) {
  const Json a = file_.at(Table::accessors, index);
  Layout l;
  auto type = a["componentType"].whole().value_or(0), count = a["count"].whole().value_or(0);
  l.size = component_size(type);
  l.component = static_cast<int>(type);
  l.width = width_of(a["type"].text());
  l.normalized = a["normalized"].boolean();
  if (!l.size || !l.width) {
    fails(index, "its type is none of glTF's");
    return std::nullopt;
  }
  if (count == 0 || count > none) {
    fails(index, "its count is no number of elements");
    return std::nullopt;
  }
  l.count = count;
  return l;
}

std::optional<ViewBytes> Accessors::place(Json of, std::size_t count, std::size_t size) {
  auto index = file_.index(Table::bufferViews, of["bufferView"]);
  auto view = index == none ? std::nullopt : buffers_.view(index);
  if (!view) return std::nullopt;
  auto offset = of["byteOffset"] ? of["byteOffset"].whole() : 0;
  const std::size_t stride = view->stride ? view->stride : size;
  bool fits = offset && stride >= size && *offset <= view->bytes.size() && size <= view->bytes.size() - *offset &&
              (count - 1) <= (view->bytes.size() - *offset - size) / stride;
  if (!fits) {
    file_.diag().report(Diag::gltf_outside, file_.where(of), "accessor", "its bufferView");
    return std::nullopt;
  }
  return ViewBytes{view->bytes.substr(*offset), stride};
}

template <class T, class Convert>
bool Accessors::read(std::uint32_t index, const Layout& l, std::vector<T>& out, Convert convert) {
  const Json a = file_.at(Table::accessors, index);
  if (a["bufferView"]) {
    auto place_ = place(a, l.count, l.element());
    if (!place_) return false;
    out.resize(l.count * l.width);
    for (std::size_t i = 0; i < l.count; ++i)
      for (std::size_t k = 0; k < l.width; ++k)
        out[i * l.width + k] = convert(place_->bytes.data() + i * place_->stride + k * l.size);
  } else {
    zeros_ += l.count * l.width;
    if (zeros_ > max_zeros) return fails(index, "it has no data for so many elements");
    out.assign(l.count * l.width, T{});
  }
  return !a["sparse"] || sparse(a["sparse"], l, out, convert);
}

template <class T, class Convert>
bool Accessors::sparse(Json json, const Layout& l, std::vector<T>& out, Convert convert) {
  auto bad = [&] {
    file_.diag().report(Diag::gltf_outside, file_.where(json), "sparse accessor", "its elements");
    return false;
  };
  const auto n = json["count"].whole().value_or(0);
  const Json indices = json["indices"], values = json["values"];
  const auto type = static_cast<int>(indices["componentType"].whole().value_or(0));
  if (n == 0 || n > l.count || !is_whole(type)) return bad();
  auto at = place(indices, n, component_size(static_cast<std::uint64_t>(type))), from = place(values, n, l.element());
  if (!at || !from) return false;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t e = whole_component(at->bytes.data() + i * at->stride, type);
    if (e >= l.count) return bad();
    for (std::size_t k = 0; k < l.width; ++k)
      out[e * l.width + k] = convert(from->bytes.data() + i * from->stride + k * l.size);
  }
  return true;
}

std::optional<Numbers> Accessors::numbers(std::uint32_t index, std::initializer_list<std::size_t> widths) {
  if (index == none) return std::nullopt;
  auto l = layout(index);
  if (!l) return std::nullopt;
  if (std::ranges::find(widths, l->width) == widths.end()) {
    fails(index, "its type does not fit its use");
    return std::nullopt;
  }
  if (l->width == 16 && l->component != float_) {
    fails(index, "its matrices are not of floats");
    return std::nullopt;
  }
  Numbers out{l->width, {}};
  if (!read(index, *l, out.values, [&](const char* p) { return component(p, l->component, l->normalized); }))
    return std::nullopt;
  return out;
}

std::optional<std::vector<std::uint32_t>> Accessors::whole(std::uint32_t index, std::size_t width) {
  if (index == none) return std::nullopt;
  auto l = layout(index);
  if (!l) return std::nullopt;
  if (l->width != width || !is_whole(l->component)) {
    fails(index, "its type does not fit its use");
    return std::nullopt;
  }
  std::vector<std::uint32_t> out;
  if (!read(index, *l, out, [&](const char* p) { return whole_component(p, l->component); })) return std::nullopt;
  return out;
}

}  // namespace wrlkit::gltf_reader
