#include "passes/lightmap/checkpoint.h"

#include <bit>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace wrlkit::bake {
namespace {

constexpr std::string_view magic = "wrlkit bake\n";
constexpr std::uint64_t largest_tile = 1u << 26;  // bytes; a damaged size must not cost memory

static_assert(std::endian::native == std::endian::little);

void put(std::string& to, std::uint64_t v) { to.append(reinterpret_cast<const char*>(&v), sizeof v); }

bool take(std::istream& in, std::uint64_t& v) { return bool(in.read(reinterpret_cast<char*>(&v), sizeof v)); }

/// Whether a file has contents that are not a checkpoint's.
bool is_foreign(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::string there(magic.size(), '\0');
  in.read(there.data(), static_cast<std::streamsize>(there.size()));
  return in.gcount() > 0 && there != magic;
}

/// Whether a file is a checkpoint that begins otherwise and has tiles: hours of work, perhaps.
bool is_of_another(const std::string& path, const std::string& head) {
  std::ifstream in(path, std::ios::binary);
  std::string there(head.size(), '\0');
  if (!in.read(there.data(), static_cast<std::streamsize>(there.size())) || there == head) return false;
  return in.peek() != std::ifstream::traits_type::eof();
}

}  // namespace

std::uint64_t hash_bytes(const void* data, std::size_t size, std::uint64_t hash) {
  auto p = static_cast<const unsigned char*>(data);
  for (std::size_t i = 0; i < size; ++i) hash = (hash ^ p[i]) * 0x100000001b3u;
  return hash;
}

Checkpoint::Checkpoint(const std::string& path, std::uint64_t key) : path_(path) {
  if (path.empty()) return;
  if (is_foreign(path))
    throw std::runtime_error("checkpoint=" + path + ": the file is not a checkpoint; choose another name");
  std::string head(magic);
  put(head, key);
  if (is_of_another(path, head)) {
    std::error_code fault;
    std::filesystem::rename(path, path + ".bak", fault);
    if (fault) throw std::system_error(fault, "checkpoint=" + path + " is that of another bake, and cannot be renamed");
    has_replaced_another_ = true;
  }
  std::uint64_t end = 0;
  {
    std::ifstream in(path, std::ios::binary);
    std::string there(head.size(), '\0');
    if (in.read(there.data(), static_cast<std::streamsize>(there.size())) && there == head) read(in, end = head.size());
  }
  errno = 0;
  if (end) std::filesystem::resize_file(path, end);
  out_.open(path, std::ios::binary | (end ? std::ios::app : std::ios::trunc));
  if (!end) out_ << head << std::flush;
  if (!out_)
    throw std::system_error(errno ? errno : EIO, std::generic_category(), "checkpoint=" + path + " cannot be written");
}

void Checkpoint::remove(const std::string& path) {
  std::error_code none_there;
  if (!is_foreign(path)) std::filesystem::remove(path, none_there);
}

void Checkpoint::read(std::istream& in, std::uint64_t& end) {
  for (std::uint64_t tile, size, sum; take(in, tile) && take(in, size) && take(in, sum) && size <= largest_tile;) {
    std::vector<char> bytes(size);
    if (!in.read(bytes.data(), static_cast<std::streamsize>(size)) || hash_bytes(bytes.data(), size) != sum) return;
    found_[tile] = std::move(bytes);
    end += 24 + size;
  }
}

const std::vector<char>* Checkpoint::find(std::uint64_t tile) const {
  auto at = found_.find(tile);
  return at == found_.end() ? nullptr : &at->second;
}

void Checkpoint::save(std::uint64_t tile, const std::vector<char>& bytes) {
  if (path_.empty()) return;
  std::string head;
  put(head, tile);
  put(head, bytes.size());
  put(head, hash_bytes(bytes.data(), bytes.size()));
  std::lock_guard lock(mutex_);
  if (error_) return;
  errno = 0;
  out_.write(head.data(), static_cast<std::streamsize>(head.size()));
  out_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out_.flush();
  if (!out_) error_ = errno ? errno : EIO;
}

}  // namespace wrlkit::bake
