// What was baked when the work was cut off: a file to which each finished tile is appended, so that the next run goes
// on from there, whatever ended the last one.
//
//   "wrlkit bake\n" key(8)   then for each tile: number(8) size(8) checksum(8) bytes
//
// Numbers are little-endian. A tail that was cut off, or does not agree with its checksum, counts as not written.
#pragma once
#include <cstdint>
#include <fstream>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

namespace wrlkit::bake {

class Checkpoint {
 public:
  /// Opens or makes the file; no path: nothing is kept. One with another key, of other work, becomes FILE.bak. Throws
  /// std::system_error when the file cannot be written, std::runtime_error when it is no checkpoint.
  Checkpoint(const std::string& path, std::uint64_t key);

  /// Deletes the file if it is a checkpoint.
  static void remove(const std::string& path);

  /// What a tile was when it was saved; null when it was not. Good as long as this object lives.
  const std::vector<char>* find(std::uint64_t tile) const;
  std::size_t n_found() const { return found_.size(); }
  /// There was one of other work.
  bool has_replaced_another() const { return has_replaced_another_; }
  /// Any number of threads may save.
  void save(std::uint64_t tile, const std::vector<char>& bytes);
  /// Why tiles could not be saved, and nothing is kept since: the number of a system error. 0: all were.
  int error() const { return error_; }

 private:
  void read(std::istream& in, std::uint64_t& end);

  std::string path_;
  std::ofstream out_;
  int error_ = 0;
  bool has_replaced_another_ = false;
  std::mutex mutex_;
  std::unordered_map<std::uint64_t, std::vector<char>> found_;
};

/// FNV-1a, 64 bits, going on from `hash`.
std::uint64_t hash_bytes(const void* data, std::size_t size, std::uint64_t hash = 0xcbf29ce484222325u);

}  // namespace wrlkit::bake
