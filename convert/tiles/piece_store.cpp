#include "convert/tiles/piece_store.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

namespace wrlkit::tiles {
namespace {

class Packer {
 public:
  template <class T>
  void number(T v) {
    bytes.append(reinterpret_cast<const char*>(&v), sizeof v);
  }
  template <class T>
  void list(std::span<const T> v) {
    number(static_cast<std::uint32_t>(v.size()));
    bytes.append(reinterpret_cast<const char*>(v.data()), v.size_bytes());
  }
  std::string bytes;
};

/// Of what Packer has packed; no more than there is.
class Unpacker {
 public:
  explicit Unpacker(std::string_view bytes) : left_(bytes) {}

  template <class T>
  T number() {
    T v{};
    take(&v, sizeof v);
    return v;
  }
  template <class List>
  void list(List& v) {
    using T = typename List::value_type;
    const std::size_t n = std::min<std::size_t>(number<std::uint32_t>(), left_.size() / sizeof(T));
    v.resize(n);
    take(v.data(), n * sizeof(T));
  }

 private:
  void take(void* to, std::size_t n) {
    if (n > left_.size()) return;
    if (n > 0) std::memcpy(to, left_.data(), n);
    left_.remove_prefix(n);
  }
  std::string_view left_;
};

enum Flag : std::uint8_t { solid = 1, convex = 2, primitive = 4 };

std::string pack(const Piece& piece) {
  const Mesh& m = piece.mesh;
  Packer out;
  out.list(std::span<const char>(piece.name));
  out.number(piece.source_size);
  out.number(m.kind);
  out.number(static_cast<std::uint8_t>(m.solid * solid + m.convex * convex + m.primitive * primitive));
  out.number(m.crease_angle);
  out.list(m.positions.span());
  out.list(std::span<const std::uint32_t>(m.corners));
  out.list(std::span<const std::uint32_t>(m.face_begin));
  for (const Attribute* a : {&m.normal, &m.color, &m.texcoord}) {
    out.number(static_cast<std::uint8_t>(a->width));
    out.list(std::span<const float>(a->values));
    out.list(std::span<const std::uint32_t>(a->index));
  }
  out.number(piece.look);  // the last: the hash is of what stands before
  return std::move(out.bytes);
}

Piece unpack(std::string_view bytes) {
  Unpacker in(bytes);
  Piece piece;
  Mesh& m = piece.mesh;
  in.list(piece.name);
  piece.source_size = in.number<std::uint32_t>();
  m.kind = in.number<Mesh::Kind>();
  const auto flags = in.number<std::uint8_t>();
  m.solid = flags & solid;
  m.convex = flags & convex;
  m.primitive = flags & primitive;
  m.crease_angle = in.number<double>();
  in.list(m.positions.edit());
  in.list(m.corners);
  in.list(m.face_begin);
  for (Attribute* a : {&m.normal, &m.color, &m.texcoord}) {
    a->width = in.number<std::uint8_t>();
    in.list(a->values);
    in.list(a->index);
  }
  piece.look = in.number<std::uint32_t>();
  return piece;
}

bool write_all(int fd, std::string_view bytes, std::uint64_t at) {
  while (!bytes.empty()) {
    const auto n = pwrite(fd, bytes.data(), bytes.size(), static_cast<off_t>(at));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(n));
    at += static_cast<std::uint64_t>(n);
  }
  return true;
}

bool read_all(int fd, std::string& bytes, std::uint64_t at) {
  for (std::size_t done = 0; done < bytes.size();) {
    const auto n = pread(fd, bytes.data() + done, bytes.size() - done, static_cast<off_t>(at + done));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    done += static_cast<std::size_t>(n);
  }
  return true;
}

}  // namespace

PieceStore::State::~State() {
  if (fd >= 0) close(fd);
}

std::optional<PieceStore> PieceStore::open(const std::string& folder, std::string& why) {
  PieceStore out;
  out.state_ = std::make_unique<State>();
  std::string name = folder + "/.pieces-XXXXXX";
  out.state_->fd = mkostemp(name.data(), O_CLOEXEC);
  if (out.state_->fd < 0) {
    why = std::generic_category().message(errno);
    return std::nullopt;
  }
  unlink(name.c_str());
  return out;
}

bool PieceStore::add(const Piece& piece, Entry& entry) {
  const auto bytes = pack(piece);
  entry = {{.bytes = static_cast<std::uint32_t>(bytes.size()),
            .n_drawn = static_cast<std::uint32_t>(n_drawn(piece.mesh)),
            .box = box_of_corners(piece.mesh),
            .look = piece.look},
           0,
           hash_of_name(piece.name),
           hash_of(std::string_view(bytes).substr(0, bytes.size() - sizeof piece.look))};
  {
    const std::scoped_lock lock(state_->mutex);
    entry.offset = state_->end;
    state_->end += bytes.size();
  }
  const bool written = write_all(state_->fd, bytes, entry.offset);
  const std::scoped_lock lock(state_->mutex);
  state_->failed |= !written;
  return !state_->failed;
}

Piece PieceStore::read(const Entry& entry) const {
  std::string bytes(entry.bytes, '\0');
  return read_all(state_->fd, bytes, entry.offset) ? unpack(bytes) : Piece{};
}

std::uint64_t hash_of_name(std::string_view name) { return hash_of(name).low; }

std::optional<std::uint64_t> write_pieces(const std::string& path, std::span<const Piece> pieces) {
  std::string name = path + "-XXXXXX";
  const int fd = mkostemp(name.data(), O_CLOEXEC);
  if (fd < 0) return std::nullopt;
  std::uint64_t end = 0;
  bool written = true;
  for (const auto& p : pieces) {
    const auto bytes = pack(p);
    Packer head;
    head.number(static_cast<std::uint32_t>(bytes.size()));
    written = written && write_all(fd, head.bytes, end) && write_all(fd, bytes, end + head.bytes.size());
    end += head.bytes.size() + bytes.size();
  }
  close(fd);
  if (written && rename(name.c_str(), path.c_str()) == 0) return end;
  unlink(name.c_str());
  return std::nullopt;
}

std::vector<Piece> read_pieces(const std::string& path) {
  std::vector<Piece> out;
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  std::string head(sizeof(std::uint32_t), '\0'), bytes;
  for (std::uint64_t at = 0; fd >= 0 && read_all(fd, head, at);) {
    bytes.resize(Unpacker(head).number<std::uint32_t>());
    if (!read_all(fd, bytes, at + head.size())) break;
    out.push_back(unpack(bytes));
    at += head.size() + bytes.size();
  }
  if (fd >= 0) close(fd);
  return out;
}

std::vector<std::uint64_t> read_names(const std::string& path) {
  std::vector<std::uint64_t> out;
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  std::string head(2 * sizeof(std::uint32_t), '\0'), name;  // the size of the piece, and that of its name
  for (std::uint64_t at = 0; fd >= 0 && read_all(fd, head, at);) {
    Unpacker sizes(head);
    const auto of_piece = sizes.number<std::uint32_t>();
    name.resize(std::min(sizes.number<std::uint32_t>(), of_piece));
    if (!read_all(fd, name, at + head.size())) break;
    out.push_back(hash_of_name(name));
    at += sizeof of_piece + of_piece;
  }
  if (fd >= 0) close(fd);
  return out;
}

}  // namespace wrlkit::tiles
