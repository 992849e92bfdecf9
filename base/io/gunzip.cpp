#include "base/io/gunzip.h"

#include <zlib.h>

#include <algorithm>
#include <vector>

namespace wrlkit {
namespace {

constexpr std::size_t piece = 256 * 1024;       // of packed data
constexpr std::size_t step = 16 * 1024 * 1024;  // unpacked between two looks at the limits

class Unpacker {
 public:
  Unpacker(std::string_view head, const ReadMore& more, const GunzipLimits& limits, BufferBuilder& out)
      : more_(more), limits_(limits), out_(out), piece_(std::max(piece, head.size())) {
    std::ranges::copy(head, piece_.begin());
    feed(head.size());
  }
  ~Unpacker() { inflateEnd(&z_); }

  Gunzip run() {
    constexpr int gzip_only = 16;
    if (inflateInit2(&z_, MAX_WBITS + gzip_only) != Z_OK) return finish(Gunzip::no_memory);
    do {
      if (!member()) return result_;
    } while (next_member());
    return result_;
  }

 private:
  Gunzip finish(Gunzip::State state, std::string why = {}) {
    result_.state = state;
    result_.why = std::move(why);
    return result_;
  }

  void feed(std::size_t n) {
    z_.next_in = reinterpret_cast<Bytef*>(piece_.data());
    z_.avail_in = static_cast<uInt>(n);
    result_.packed += n;
  }

  /// False at the end of the packed data.
  bool refill() {
    if (z_.avail_in == 0) feed(more_(piece_));
    return z_.avail_in > 0;
  }

  /// One member; false when reading cannot go on after it.
  bool member() {
    for (int status = Z_OK; status != Z_STREAM_END;) {
      if (!refill()) {
        finish(Gunzip::damaged, "it ends too early");
        return false;
      }
      if (out_.room() == 0 && !out_.grow()) {
        finish(Gunzip::no_memory);
        return false;
      }
      auto room = static_cast<uInt>(std::min(out_.room(), step));
      z_.next_out = reinterpret_cast<Bytef*>(out_.end());
      z_.avail_out = room;
      status = inflate(&z_, Z_NO_FLUSH);
      out_.added(room - z_.avail_out);
      if (status == Z_MEM_ERROR) {
        finish(Gunzip::no_memory);
        return false;
      }
      if (status != Z_OK && status != Z_STREAM_END) {
        finish(Gunzip::damaged, z_.msg ? z_.msg : "unknown method");
        return false;
      }
      if (too_much()) return false;
    }
    return true;
  }

  std::uint64_t consumed() const { return result_.packed - z_.avail_in; }

  bool too_much() {
    auto unpacked = static_cast<double>(out_.size()), packed = static_cast<double>(consumed());
    if (out_.size() > limits_.ratio_from && unpacked > limits_.ratio * packed) {
      finish(Gunzip::too_high_ratio);
      return true;
    }
    if (out_.size() <= limits_.bytes) return false;
    out_.cut(limits_.bytes);
    finish(Gunzip::too_many_bytes);
    return true;
  }

  /// Goes to the next member, over padding; false at the end, or when something else follows.
  bool next_member() {
    while (refill() && *z_.next_in == 0) {
      ++z_.next_in;
      --z_.avail_in;
    }
    if (z_.avail_in == 0) return false;
    if (*z_.next_in != 0x1f) {
      finish(Gunzip::damaged, "something else follows it");
      return false;
    }
    return inflateReset(&z_) == Z_OK;
  }

  const ReadMore& more_;
  const GunzipLimits& limits_;
  BufferBuilder& out_;
  std::vector<char> piece_;
  z_stream z_{};
  Gunzip result_;
};

}  // namespace

Gunzip gunzip(std::string_view head, const ReadMore& more, const GunzipLimits& limits, BufferBuilder& out) {
  return Unpacker(head, more, limits, out).run();
}

}  // namespace wrlkit
