#include "base/io/gzip.h"

#include <zlib.h>

#include <array>
#include <cerrno>
#include <new>

namespace wrlkit {

struct Gzip::State {
  z_stream z{};
  gz_header header{};
  bool ok = false;
  std::array<Bytef, 256 * 1024> packed;

  int run(int flush, const Put& put) {
    do {
      z.next_out = packed.data();
      z.avail_out = static_cast<uInt>(packed.size());
      deflate(&z, flush);
      std::string_view out(reinterpret_cast<char*>(packed.data()), packed.size() - z.avail_out);
      if (int error = out.empty() ? 0 : put(out)) return error;
    } while (z.avail_out == 0);
    return 0;
  }
};

Gzip::Gzip() : state_(std::make_unique<State>()) {
  constexpr int gzip = 16, memory = 9;
  auto& s = *state_;
  s.ok = deflateInit2(&s.z, Z_DEFAULT_COMPRESSION, Z_DEFLATED, MAX_WBITS + gzip, memory, Z_DEFAULT_STRATEGY) == Z_OK;
  s.header.os = 255;  // unknown: not the machine's
  s.ok = s.ok && deflateSetHeader(&s.z, &s.header) == Z_OK;
}

Gzip::~Gzip() { deflateEnd(&state_->z); }

int Gzip::pack(std::string_view piece, bool last, const Put& put) {
  if (!state_->ok) return ENOMEM;
  constexpr std::size_t step = std::size_t{1} << 30;  // zlib counts in 32 bits
  do {
    auto now = piece.substr(0, step);
    piece.remove_prefix(now.size());
    state_->z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(now.data()));
    state_->z.avail_in = static_cast<uInt>(now.size());
    if (int error = state_->run(last && piece.empty() ? Z_FINISH : Z_NO_FLUSH, put)) return error;
  } while (!piece.empty());
  return 0;
}

std::string gzipped(std::string_view bytes) {
  std::string out;
  if (Gzip().pack(bytes, true, [&](std::string_view s) {
        out += s;
        return 0;
      }))
    throw std::bad_alloc();
  return out;
}

std::uint64_t gzipped_size(std::span<const std::string_view> pieces) {
  std::uint64_t size = 0;
  const Gzip::Put count = [&](std::string_view packed) {
    size += packed.size();
    return 0;
  };
  Gzip gzip;
  for (auto p : pieces) gzip.pack(p, false, count);
  gzip.pack({}, true, count);
  return size;
}

}  // namespace wrlkit
