#include <cmath>

#include "geometry/progressive/progressive_replay.h"
#include "geometry/progressive/progressive_stream.h"

namespace wrlkit {
namespace {

using namespace simplify;
using Record = ProgressiveRecord;

constexpr std::uint64_t most = 1u << 30;  // of anything: three corners of that many faces have numbers of 32 bits

/// What is wrong with the bytes, thrown within this file only.
struct Fault {
  const char* what;
};
void require(bool holds, const char* what) {
  if (!holds) throw Fault{what};
}

class Reader {
 public:
  explicit Reader(std::string_view bytes) : in_(bytes), code_(0) {}

  ProgressiveRead run() {
    ProgressiveRead out;
    try {
      header();
      base();
      require(!in_.ended(), "the bytes end before the base mesh does");
      while (out_.splits.size() < n_splits_ && split()) {
      }
      out.complete = out_.splits.size() == n_splits_;
      require(!out.complete || out_.faces.size() == n_faces_, "there are fewer faces than the header says");
      require(!out.complete || in_.left() == 0, "there are bytes behind the last split");
      out.record = std::move(out_);
    } catch (const Fault& fault) {
      out.error = in_.ended() && !based_ ? "the bytes end before the base mesh does" : fault.what;
    }
    return out;
  }

 private:
  using Corner = Record::Corner;
  using Point = Record::Point;

  void header() {
    require(in_.bytes(progressive_magic.size()) == progressive_magic, "not a progressive mesh, or of another version");
    const std::uint8_t flags = in_.byte();
    require(flags < 128, "unknown flags");
    Mesh& m = out_.flags;
    m.kind = Mesh::Kind::faces;
    m.ccw = flags & mesh_bits::ccw;
    m.solid = flags & mesh_bits::solid;
    m.convex = flags & mesh_bits::convex;
    out_.n_normal = flags & mesh_bits::normal ? 3 : 0;
    out_.n_color = !(flags & mesh_bits::color) ? 0 : flags & mesh_bits::alpha ? 4 : 3;
    out_.n_texcoord = flags & mesh_bits::texcoord ? 2 : 0;
    const std::uint8_t kind = in_.byte();
    require(kind <= PositionCode::shortest, "unknown kind of positions");
    code_ = PositionCode(kind);
    m.crease_angle = in_.fixed<double>();
    require(std::isfinite(m.crease_angle), "the crease angle is no angle");
    in_.bytes(6 * sizeof(float));  // bounds
    error_ = out_.base_error = in_.fixed<float>();
    require(std::isfinite(error_) && !std::signbit(error_), "the error of the base is not a valid length");
    n_base_vertices_ = count();
    n_base_wedges_ = count();
    n_base_faces_ = count();
    n_splits_ = count();
    n_faces_ = count();
    require(n_base_vertices_ + n_splits_ <= most && n_base_faces_ <= n_faces_, "counts that contradict one another");
    require(out_.width() > 0 || n_base_wedges_ == 0, "wedges without attributes");
  }

  std::uint64_t count() {
    const std::uint64_t n = in_.number();
    require(n <= most, "a count is too large");
    return n;
  }

  void base() {
    std::uint64_t number = 0;
    Point before{};
    for (std::uint64_t v = 0; v < n_base_vertices_; ++v) {
      number = ascending(number, n_base_vertices_ + n_splits_);
      before = point(before);
      add_vertex(before, number++);
    }
    for (std::uint64_t w = 0; w < n_base_wedges_; ++w)
      new_wedge(w ? &out_.values[out_.values.size() - width()] : nullptr);
    number = 0;
    Corner last;
    for (std::uint64_t f = 0; f < n_base_faces_; ++f) {
      Record::Face face;
      face.number = static_cast<std::uint32_t>(number = ascending(number, n_faces_));
      ++number;
      for (Corner& c : face.corners) {
        c.vertex = index(last.vertex, out_.vertices.size());
        if (width()) c.wedge = index(last.wedge, out_.wedges.size());
        last = c;
      }
      const auto& c = face.corners;
      require(c[0].vertex != c[1].vertex && c[1].vertex != c[2].vertex && c[2].vertex != c[0].vertex,
              "a face has a vertex twice");
      add_face(face);
    }
    out_.n_base_vertices = out_.vertices.size();
    out_.n_base_wedges = out_.wedges.size();
    out_.n_base_faces = out_.faces.size();
    based_ = !in_.ended();
  }

  /// Each of these stops at the end of the bytes, so that no loop runs on without them.
  std::uint64_t ascending(std::uint64_t from, std::uint64_t bound) {
    const std::uint64_t gap = in_.number();
    require(!in_.ended() && gap < bound && from + gap < bound, "a number is out of range");
    return from + gap;
  }
  std::uint32_t index(std::uint32_t from, std::size_t bound) {
    const std::int64_t step = in_.whole();
    require(!in_.ended() && std::abs(static_cast<double>(step)) <= most, "an index is out of range");
    const std::int64_t i = from + step;
    require(i >= 0 && static_cast<std::uint64_t>(i) < bound, "an index is out of range");
    return static_cast<std::uint32_t>(i);
  }
  std::uint32_t below(std::size_t bound) {
    const std::uint64_t i = in_.number();
    require(!in_.ended() && i < bound, "an index is out of range");
    return static_cast<std::uint32_t>(i);
  }

  std::size_t width() const { return static_cast<std::size_t>(out_.width()); }

  Point point(const Point& predicted) {
    Point p;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto x = code_.read(in_, predicted[i]);
      require(x && !in_.ended(), "a position is no finite number");
      p[i] = *x;
    }
    return p;
  }

  void add_vertex(const Point& p, std::uint64_t number) {
    out_.vertices.push_back({p, static_cast<std::uint32_t>(number)});
    replay_.add_vertex(p);
  }
  void add_face(const Record::Face& face) {
    out_.faces.push_back(face);
    replay_.add_face(face.corners);
  }

  /// A row of values behind the others, from the differences to the row at `from` (null: from 0); its number.
  std::uint32_t values(const float* from) {
    std::array<float, 9> row;
    for (std::size_t i = 0; i < width(); ++i) {
      const std::int64_t step = in_.whole(), least = from ? ordered(from[i]) : 0;
      require(!in_.ended() && std::abs(static_cast<double>(step)) <= 4. * most * 4, "a value is out of range");
      const std::int64_t n = least + step;
      require(n >= -(std::int64_t{1} << 31) && n < std::int64_t{1} << 31, "a value is out of range");
      row[i] = from_ordered(n);
    }
    out_.values.insert(out_.values.end(), row.begin(), row.begin() + static_cast<std::ptrdiff_t>(width()));
    return static_cast<std::uint32_t>(out_.values.size() / width() - 1);
  }

  const float* row_of(std::uint32_t wedge) const { return &out_.values[replay_.row[wedge] * width()]; }

  std::uint32_t new_wedge(const float* like) {
    const std::uint32_t row = values(like);
    out_.wedges.push_back(row);
    replay_.row.push_back(row);
    became_.push_back(0);
    return static_cast<std::uint32_t>(out_.wedges.size() - 1);
  }

  /// False, and nothing done, when the bytes end within it.
  bool split() {
    const auto old_vertices = out_.vertices.size(), old_wedges = out_.wedges.size(), old_faces = out_.faces.size();
    const auto old_corners = out_.corners.size(), old_changes = out_.wedge_changes.size(),
               old_values = out_.values.size();
    try {
      read_split();
    } catch (const Fault&) {
      if (!in_.ended()) throw;
    }
    if (!in_.ended()) return true;
    out_.vertices.resize(old_vertices);
    out_.wedges.resize(old_wedges);
    out_.faces.resize(old_faces);
    out_.corners.resize(old_corners);
    out_.wedge_changes.resize(old_changes);
    out_.values.resize(old_values);
    return false;
  }

  void read_split() {
    const std::uint8_t head = in_.byte();
    require(head < 64 && (out_.width() || head < split_bits::wedges), "unknown flags of a split");
    std::uint64_t n_faces = head & split_bits::n_faces;
    if (n_faces == 3) n_faces += in_.number();
    const std::uint32_t v = below(out_.vertices.size());
    if (head & split_bits::better) {
      const std::uint64_t step = in_.number(), now = static_cast<std::uint64_t>(ordered(error_));
      require(step <= now, "an error is not a valid length");
      error_ = from_ordered(static_cast<std::int64_t>(now - step));
    }
    const std::uint32_t number = index(out_.vertices[v].number, n_base_vertices_ + n_splits_);
    const Point coarse = replay_.position[v];
    positions(v, head & split_bits::moves, number);
    const auto born = static_cast<std::uint32_t>(out_.vertices.size() - 1);
    move_corners(v, born, head & split_bits::wedges);
    for (std::uint64_t i = 0; i < n_faces; ++i) face(v, born);
    if (head & split_bits::values) wedge_values();
    if (in_.ended()) return;
    out_.splits.push_back(
        {v, coarse, replay_.position[v], error_, out_.faces.size(), out_.corners.size(), out_.wedge_changes.size()});
  }

  void positions(std::uint32_t v, bool moves, std::uint32_t number) {
    Point& p = replay_.position[v];
    Point predicted = p;
    if (moves) {
      const Point q = point(p);
      for (std::size_t k = 0; k < 3; ++k) predicted[k] = Replay::opposite(p[k], q[k]);
      p = q;
    }
    add_vertex(point(predicted), number);
  }

  void move_corners(std::uint32_t v, std::uint32_t born, bool one_by_one) {
    replay_.take_fan(v, fan_);
    stay_.clear();
    go_.clear();
    std::uint8_t mask = 0;
    for (std::size_t i = 0; i < fan_.size(); ++i) {
      if (i % 8 == 0) mask = in_.byte();
      require(!in_.ended(), "");
      const bool goes = mask >> i % 8 & 1;
      (goes ? go_ : stay_).push_back(fan_[i]);
      replay_.append(goes ? born : v, fan_[i]);
    }
    const auto first_new = static_cast<std::uint32_t>(out_.wedges.size());
    for (std::uint32_t c : go_) {
      const std::uint32_t coarse = replay_.corner[c].wedge,
                          fine = width() ? fine_wedge(coarse, first_new, one_by_one) : 0;
      out_.corners.push_back({c, coarse, fine});
      replay_.corner[c] = {born, fine};
    }
  }

  /// What becomes of the wedge of a corner that goes.
  std::uint32_t fine_wedge(std::uint32_t coarse, std::uint32_t first_new, bool one_by_one) {
    const auto next = static_cast<std::uint32_t>(out_.wedges.size());
    if (one_by_one) {
      const std::uint32_t code = below(std::size_t{next} - first_new + 2), fine = first_new + code - 1;
      return code == 0 ? coarse : fine < next ? fine : new_wedge(row_of(coarse));
    }
    if (became_[coarse] < first_new) became_[coarse] = new_wedge(row_of(coarse));
    return became_[coarse];
  }

  void face(std::uint32_t v, std::uint32_t born) {
    const std::uint32_t code = below(12 * fan_.size() + 6), place = code / 6, turn = code / 2 % 3;
    const std::uint32_t born_at = (turn + (code % 2 ? 1 : 2)) % 3;
    const bool far = place == 2 * fan_.size();
    Record::Face face;
    std::uint32_t like = out_.faces.empty() ? 0 : out_.faces.back().number;
    if (far) {
      face.corners[turn].vertex = below(out_.vertices.size());
      require(face.corners[turn].vertex != v && face.corners[turn].vertex != born, "a face has a vertex twice");
    } else {
      face.corners[turn] = replay_.corner[Replay::neighbour(fan_[place / 2], place % 2)];
      like = out_.faces[fan_[place / 2] / 3].number;
    }
    face.number = index(like, n_faces_);
    require(out_.faces.size() < n_faces_, "there are more faces than the header says");
    for (std::uint32_t k = 0; k < 3; ++k) {
      if (k != turn) face.corners[k].vertex = k == born_at ? born : v;
      if (width() && k != turn)
        face.corners[k].wedge = near_wedge(k == born_at ? go_ : stay_);
      else if (width() && far)
        face.corners[k].wedge = far_wedge();
    }
    const auto first = static_cast<std::uint32_t>(3 * out_.faces.size());
    add_face(face);
    go_.push_back(first + born_at);
    stay_.push_back(first + 3 - turn - born_at);
  }

  std::uint32_t far_wedge() {
    const std::uint32_t w = below(out_.wedges.size() + 1);
    return w < out_.wedges.size() ? w : new_wedge(nullptr);
  }

  std::uint32_t near_wedge(const std::vector<std::uint32_t>& corners) {
    const std::uint32_t code = below(corners.size() + 1 + out_.wedges.size());
    if (code < corners.size()) return replay_.corner[corners[code]].wedge;
    if (code > corners.size()) return static_cast<std::uint32_t>(code - corners.size() - 1);
    return new_wedge(corners.empty() ? nullptr : row_of(replay_.corner[corners[0]].wedge));
  }

  void wedge_values() {
    for (std::uint64_t n = in_.number(); n > 0; --n) {
      const std::uint32_t w = below(out_.wedges.size()), coarse = replay_.row[w];
      replay_.row[w] = values(row_of(w));
      out_.wedge_changes.push_back({w, coarse, replay_.row[w]});
    }
  }

  ByteReader in_;
  PositionCode code_;
  Record out_;
  Replay replay_;
  std::uint64_t n_base_vertices_ = 0, n_base_wedges_ = 0, n_base_faces_ = 0, n_splits_ = 0, n_faces_ = 0;
  float error_ = 0;
  bool based_ = false;                          // the base has been read
  std::vector<std::uint32_t> fan_, stay_, go_;  // corners of the vertex that is split, before, and of both behind
  std::vector<std::uint32_t> became_;           // of each wedge, in the last split where it became a new one
};

}  // namespace

ProgressiveRead read_progressive(std::string_view bytes) { return Reader(bytes).run(); }

}  // namespace wrlkit
