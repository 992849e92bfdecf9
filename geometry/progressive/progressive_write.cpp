#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "base/math/box.h"
#include "geometry/progressive/progressive_replay.h"
#include "geometry/progressive/progressive_stream.h"

namespace wrlkit {
namespace {

using namespace simplify;
using Record = ProgressiveRecord;

constexpr std::size_t bytes_between_cuts = 4096;

/// The positions of the original.
std::vector<Record::Point> final_positions(const Record& record) {
  std::vector<Record::Point> out;
  for (const auto& v : record.vertices) out.push_back(v.position);
  for (const auto& s : record.splits) out[s.vertex] = s.fine;
  return out;
}

class Writer {
 public:
  Writer(const Record& record, PositionCode code) : in_(record), code_(code), out_(stream_.bytes) {}

  ProgressiveStream run() {
    header();
    base();
    cut();
    for (std::size_t i = 0; i < in_.splits.size(); ++i) {
      split(i);
      if (stream_.bytes.size() - stream_.cuts.back().end >= bytes_between_cuts) cut();
    }
    if (stream_.cuts.back().end < stream_.bytes.size()) cut();
    return std::move(stream_);
  }

 private:
  using Corner = Record::Corner;
  using Point = Record::Point;

  void cut() { stream_.cuts.push_back({stream_.bytes.size(), error_}); }

  void header() {
    const Mesh& m = in_.flags;
    out_.bytes(progressive_magic);
    std::uint8_t flags = 0;
    auto flag = [&](bool on, std::uint8_t bit) { flags |= on ? bit : 0; };
    flag(m.ccw, mesh_bits::ccw);
    flag(m.solid, mesh_bits::solid);
    flag(m.convex, mesh_bits::convex);
    flag(in_.n_normal, mesh_bits::normal);
    flag(in_.n_color, mesh_bits::color);
    flag(in_.n_color == 4, mesh_bits::alpha);
    flag(in_.n_texcoord, mesh_bits::texcoord);
    out_.byte(flags);
    out_.byte(code_.kind());
    out_.fixed(m.crease_angle);
    bounds();
    out_.fixed(error_ = in_.base_error);
    for (std::size_t n :
         {in_.n_base_vertices, in_.n_base_wedges, in_.n_base_faces, in_.splits.size(), in_.faces.size()})
      out_.number(n);
  }

  /// The bounds of the original: smallest x, y, z and largest, rounded outwards.
  void bounds() {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    Box box;
    for (const Point& p : final_positions(in_)) box.add(p);
    if (in_.vertices.empty()) box = {{}, {}};
    for (double x : box.low) out_.fixed(outward(x, -infinity));
    for (double x : box.high) out_.fixed(outward(x, infinity));
  }

  static float outward(double x, float towards) {
    const auto f = static_cast<float>(x);
    return (towards > 0 ? f < x : f > x) ? std::nextafter(f, towards) : f;
  }

  void base() {
    std::uint32_t number = 0;
    Point before{};
    for (std::size_t v = 0; v < in_.n_base_vertices; ++v) {
      out_.number(in_.vertices[v].number - number);
      number = in_.vertices[v].number + 1;
      replay_.add_vertex(before = point(in_.vertices[v].position, before));
    }
    for (std::size_t w = 0; w < in_.n_base_wedges; ++w) new_wedge(w ? in_.wedges[w - 1] : Replay::none);
    number = 0;
    Corner last;
    for (std::size_t f = 0; f < in_.n_base_faces; ++f) {
      const auto& face = in_.faces[f];
      out_.number(face.number - number);
      number = face.number + 1;
      for (const Corner& c : face.corners) {
        out_.whole(std::int64_t{c.vertex} - last.vertex);
        if (in_.width()) out_.whole(std::int64_t{c.wedge} - last.wedge);
        last = c;
      }
      replay_.add_face(face.corners);
    }
  }

  /// As the reader will have it.
  Point point(const Point& p, const Point& predicted) {
    Point out;
    for (std::size_t i = 0; i < 3; ++i) {
      code_.write(out_, p[i], predicted[i]);
      out[i] = code_.nearest(p[i]);
    }
    return out;
  }

  /// Values of the row `to`, as differences from those of `from` (none: from 0).
  void values(std::uint32_t to, std::uint32_t from) {
    const auto width = static_cast<std::size_t>(in_.width());
    for (std::size_t i = 0; i < width; ++i)
      out_.whole(ordered(in_.values[to * width + i]) -
                 (from == Replay::none ? 0 : ordered(in_.values[from * width + i])));
  }

  void new_wedge(std::uint32_t like) {
    const std::uint32_t row = in_.wedges[replay_.row.size()];
    values(row, like);
    replay_.row.push_back(row);
  }

  void split(std::size_t i) {
    const auto& s = in_.splits[i];
    const auto* before = i ? &in_.splits[i - 1] : nullptr;
    begin_.faces = before ? before->end_of_faces : in_.n_base_faces;
    begin_.corners = before ? before->end_of_corners : 0;
    begin_.wedges = before ? before->end_of_wedges : 0;
    const Point fine = rounded(s.fine);
    const bool moves = fine != replay_.position[s.vertex];
    const std::size_t n_faces = s.end_of_faces - begin_.faces;
    const bool one_by_one = in_.width() && !wedges_are_plain(s);
    out_.byte(static_cast<std::uint8_t>(std::min<std::size_t>(n_faces, 3) | (moves ? split_bits::moves : 0) |
                                        (s.error < error_ ? split_bits::better : 0) |
                                        (one_by_one ? split_bits::wedges : 0) |
                                        (s.end_of_wedges > begin_.wedges ? split_bits::values : 0)));
    if (n_faces >= 3) out_.number(n_faces - 3);
    out_.number(s.vertex);
    if (s.error < error_) {
      out_.number(static_cast<std::uint64_t>(ordered(error_) - ordered(s.error)));
      error_ = s.error;
    }
    const std::size_t born = in_.n_base_vertices + i;
    out_.whole(std::int64_t{in_.vertices[born].number} - in_.vertices[s.vertex].number);
    positions(s.vertex, moves, s.fine, in_.vertices[born].position);
    move_corners(s, static_cast<std::uint32_t>(born), one_by_one);
    for (std::size_t f = begin_.faces; f < s.end_of_faces; ++f) face(f, s.vertex, static_cast<std::uint32_t>(born));
    if (s.end_of_wedges > begin_.wedges) wedge_values(s);
  }

  Point rounded(const Point& p) const { return {code_.nearest(p[0]), code_.nearest(p[1]), code_.nearest(p[2])}; }

  void positions(std::uint32_t v, bool moves, const Point& fine, const Point& born) {
    Point& p = replay_.position[v];
    Point predicted = p;
    if (moves) {
      const Point q = point(fine, p);
      for (std::size_t k = 0; k < 3; ++k) predicted[k] = Replay::opposite(p[k], q[k]);
      p = q;
    }
    replay_.add_vertex(point(born, predicted));
  }

  /// Whether each wedge of the corners that go becomes a new one, in the order in which they come.
  bool wedges_are_plain(const Record::Split& s) const {
    std::map<std::uint32_t, std::uint32_t> becomes;
    auto next = static_cast<std::uint32_t>(replay_.row.size());
    for (std::size_t k = begin_.corners; k < s.end_of_corners; ++k) {
      const auto [at, is_first] = becomes.try_emplace(in_.corners[k].coarse, next);
      next += is_first;
      if (in_.corners[k].fine != at->second) return false;
    }
    return true;
  }

  void move_corners(const Record::Split& s, std::uint32_t born, bool one_by_one) {
    replay_.take_fan(s.vertex, fan_);
    stay_.clear();
    go_.clear();
    std::size_t k = begin_.corners;
    std::uint8_t mask = 0;
    for (std::size_t i = 0; i < fan_.size(); ++i) {
      const bool goes = k < s.end_of_corners && in_.corners[k].corner == fan_[i];
      if (goes) {
        ++k;
        mask |= static_cast<std::uint8_t>(1 << i % 8);
      }
      (goes ? go_ : stay_).push_back(fan_[i]);
      replay_.append(goes ? born : s.vertex, fan_[i]);
      if (i % 8 == 7 || i + 1 == fan_.size()) {
        out_.byte(mask);
        mask = 0;
      }
    }
    const auto first_new = static_cast<std::uint32_t>(replay_.row.size());
    for (k = begin_.corners; k < s.end_of_corners; ++k) {
      const auto& c = in_.corners[k];
      const bool keeps = c.fine == c.coarse;
      if (one_by_one) out_.number(keeps ? 0 : c.fine - first_new + 1);
      if (in_.width() && !keeps && c.fine == replay_.row.size()) new_wedge(replay_.row[c.coarse]);
      replay_.corner[c.corner] = {born, c.fine};
    }
  }

  /// The corner opposite to the edge of the two vertices is one that a face of the fan has as well; which, and how the
  /// face is turned, is one number.
  void face(std::size_t f, std::uint32_t v, std::uint32_t born) {
    const auto& face = in_.faces[f];
    std::uint32_t turn = 0;
    while (face.corners[turn].vertex == v || face.corners[turn].vertex == born) ++turn;
    const bool born_is_next = face.corners[(turn + 1) % 3].vertex == born;
    const Corner& x = face.corners[turn];
    std::size_t place = 0;
    while (place < 2 * fan_.size() && replay_.corner[Replay::neighbour(fan_[place / 2], place % 2)] != x) ++place;
    out_.number(place * 6 + turn * 2 + born_is_next);
    std::uint32_t like = f ? in_.faces[f - 1].number : 0;
    const bool far = place == 2 * fan_.size();
    if (far)
      out_.number(x.vertex);
    else
      like = in_.faces[fan_[place / 2] / 3].number;
    out_.whole(std::int64_t{face.number} - like);
    const std::uint32_t born_at = (turn + (born_is_next ? 1 : 2)) % 3;
    for (std::uint32_t k = 0; in_.width() && k < 3; ++k) {
      if (k != turn)
        near_wedge(face.corners[k].wedge, k == born_at ? go_ : stay_);
      else if (far)
        far_wedge(x.wedge);
    }
    replay_.add_face(face.corners);
    go_.push_back(static_cast<std::uint32_t>(3 * f + born_at));
    stay_.push_back(static_cast<std::uint32_t>(3 * f + 3 - turn - born_at));
  }

  void far_wedge(std::uint32_t w) {
    out_.number(w);
    if (w == replay_.row.size()) new_wedge(Replay::none);
  }

  /// One of the wedges of these corners, by its place; or the next new one; or any, by its number.
  void near_wedge(std::uint32_t w, const std::vector<std::uint32_t>& corners) {
    const auto at = std::ranges::find(corners, w, [&](std::uint32_t c) { return replay_.corner[c].wedge; });
    if (at != corners.end()) return out_.number(static_cast<std::uint64_t>(at - corners.begin()));
    if (w < replay_.row.size()) return out_.number(corners.size() + 1 + w);
    out_.number(corners.size());
    new_wedge(corners.empty() ? Replay::none : replay_.row[replay_.corner[corners[0]].wedge]);
  }

  void wedge_values(const Record::Split& s) {
    out_.number(s.end_of_wedges - begin_.wedges);
    for (std::size_t k = begin_.wedges; k < s.end_of_wedges; ++k) {
      const auto& change = in_.wedge_changes[k];
      out_.number(change.wedge);
      values(change.fine, replay_.row[change.wedge]);
      replay_.row[change.wedge] = change.fine;
    }
  }

  const Record& in_;
  PositionCode code_;
  ProgressiveStream stream_;
  ByteWriter out_;
  Replay replay_;
  float error_ = 0;
  struct {
    std::size_t faces, corners, wedges;
  } begin_{};                                   // of the entries of the split at work
  std::vector<std::uint32_t> fan_, stay_, go_;  // corners of its vertex, before, and of both behind
};

bool holds(PositionCode code, const std::vector<Record::Point>& points) {
  return std::ranges::all_of(
      points, [&](const auto& p) { return std::ranges::all_of(p, [&](double x) { return code.holds(x); }); });
}

}  // namespace

ProgressiveStream write_progressive(const ProgressiveRecord& record) {
  const auto points = final_positions(record);
  std::optional<ProgressiveStream> best;
  auto attempt = [&](std::uint8_t kind) {
    auto stream = Writer(record, PositionCode(kind)).run();
    if (!best || stream.bytes.size() < best->bytes.size()) best = std::move(stream);
  };
  auto attempt_first = [&](std::uint8_t first, std::uint8_t last) {
    for (std::uint8_t kind = first; kind <= last; ++kind)
      if (holds(PositionCode(kind), points)) return attempt(kind);
  };
  attempt_first(0, PositionCode::max_digits);
  attempt_first(PositionCode::single, PositionCode::single);
  attempt_first(PositionCode::printed, PositionCode::shortest);
  if (!best) attempt(PositionCode::real);
  return std::move(*best);
}

}  // namespace wrlkit
