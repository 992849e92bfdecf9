// Pieces go into the strip one after the other, the largest first, each to the lowest place that it finds in any of its
// quarter turns.
#include "geometry/unwrap/pack.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/stop.h"
#include "geometry/unwrap/strip.h"

namespace wrlkit::unwrap {
namespace {

Point2 turned(Point2 p, int quarters) {
  switch (quarters & 3) {
    case 0:
      return p;
    case 1:
      return {-p.y, p.x};
    case 2:
      return {-p.x, -p.y};
    default:
      return {p.y, -p.x};
  }
}

/// Texels for a length; what is beyond by less than the slack of masks is nothing.
int texels(double length) { return std::max(1, static_cast<int>(std::ceil(length - 1e-3))); }

/// A rectangle of texels and what is in it.
struct Piece {
  std::uint32_t item = 0, part = 0;  // chart of the item, or its copy
  bool whole = false;                // the item, not a chart of it
  int width = 0, height = 0;
  double scale = 1;
};

struct Spotted {
  Spot at;
  int quarters = 0;
};

/// Where a piece that lies there, in a box of that size before it was turned, has its origin.
Placement placement(const Piece& p, const Spotted& s, Point2 offset) {
  Placement r;
  r.quarter_turns = s.quarters;
  r.scale = p.scale;
  double w = p.width, h = p.height;
  Point2 corner[4] = {{0, 0}, {h, 0}, {w, h}, {0, w}};
  Point2 o = turned(offset, s.quarters) + corner[s.quarters];
  r.x = o.x + s.at.x;
  r.y = o.y + s.at.y;
  return r;
}

/// Fills a strip with pieces; knows where there is no use in looking for pieces of a size.
class Filler {
 public:
  explicit Filler(Strip& strip) : strip_(strip), from_(64 * 64, 0) {}

  Spotted place(const Bitmap& bitmap) {
    turn(bitmap);
    std::optional<Spotted> best;
    for (int q = 0; q < n_turns_; ++q) try_turn(q, best);
    strip_.put(masks_[best->quarters], best->at);
    return *best;
  }

 private:
  static std::size_t size_class(int n) {
    return static_cast<std::size_t>(n < 16 ? n : std::min(63., 4 * std::log2(n)));
  }

  void turn(const Bitmap& bitmap) {
    masks_[0].make(bitmap);
    std::size_t bits = 0;
    for (const Mask::Run& r : masks_[0].runs) bits += r.last - r.first + 1;
    double full = static_cast<double>(bits) / bitmap.width() / bitmap.height();
    n_turns_ = full < 0.95 ? 4 : bitmap.width() == bitmap.height() ? 1 : 2;
    const Bitmap* from = &bitmap;
    for (int q = 1; q < n_turns_; ++q) {
      turn_quarter(*from, turned_[q & 1]);
      from = &turned_[q & 1];
      masks_[q].make(*from);
    }
  }

  void try_turn(int q, std::optional<Spotted>& best) {
    const Mask& m = masks_[q];
    if (m.width > strip_.width()) return;
    int& from = from_[size_class(m.width) * 64 + size_class(m.height)];
    int last = best ? best->at.y + masks_[best->quarters].height - m.height - 1 : 1 << 28;
    auto spot = strip_.find(m, from, last);
    if (!spot) return;
    from = std::min(spot->y, best && best->quarters == (q & 1) ? best->at.y : spot->y);
    best = {*spot, q};
  }

  Strip& strip_;
  std::vector<int> from_;  // by size class of width and height: the row from which on to look
  Mask masks_[4];
  Bitmap turned_[2];
  int n_turns_ = 1;
};

class Packer {
 public:
  Packer(std::span<const PackItem> items, const PackOptions& options) : items_(items), options_(options) {
    units_.resize(items.size());
  }

  /// Packs all at densities times the factor into pages of that size; height 0: one endless page.
  int run(double factor, int width, int height);
  Atlas atlas() const { return atlas_; }
  /// Whether something had to be scaled down to fit into a page at all.
  bool shrunk() const { return shrunk_; }

  double area() const {
    return sum([](double w, double h) { return w * h; });
  }
  double perimeter() const {
    return sum([](double w, double h) { return w + h; });
  }
  double pieces() const {
    return sum([](double, double) { return 1.0; });
  }
  double longest() const {
    double l = 0;
    for (const PackItem& item : items_)
      for (const Point2f& size : item.charts->sizes) l = std::max(l, std::max(size.x, size.y) * item.density);
    return l;
  }

 private:
  template <class F>
  double sum(F&& f) const {
    double s = 0;
    for (const PackItem& item : items_)
      for (const Point2f& size : item.charts->sizes) s += item.copies * f(size.x * item.density, size.y * item.density);
    return s;
  }

  Piece chart_piece(std::uint32_t item, std::uint32_t chart, double factor, int side) const;
  void draw(const Piece& piece, Bitmap& to) const;
  Point2 offset(const Piece& piece) const;
  void make_unit(std::uint32_t item, double factor, int side);
  void add_to_unit(const Piece& piece, Spotted spot, Bitmap& unit);
  std::vector<Piece> make_pieces(double factor, int side);
  static void sort(std::vector<Piece>& pieces);

  std::span<const PackItem> items_;
  PackOptions options_;
  std::vector<Bitmap> units_;
  Bitmap bitmap_;
  Atlas atlas_;
  bool shrunk_ = false;
};

void Packer::sort(std::vector<Piece>& pieces) {
  auto key = [](const Piece& p) { return std::pair{-std::max(p.width, p.height), -std::min(p.width, p.height)}; };
  std::stable_sort(pieces.begin(), pieces.end(), [&](const Piece& a, const Piece& b) { return key(a) < key(b); });
}

Piece Packer::chart_piece(std::uint32_t item, std::uint32_t chart, double factor, int side) const {
  Point2f size = items_[item].charts->sizes[chart];
  double scale = items_[item].density * factor, longest = std::max(size.x, size.y);
  if (longest * scale > side) scale = side / longest;
  return {item, chart, false, texels(size.x * scale), texels(size.y * scale), scale};
}

/// Charts lie in the middle of their texels: so a chart of less than one covers the middle of it.
Point2 Packer::offset(const Piece& p) const {
  if (p.whole) return {};
  Point2f size = items_[p.item].charts->sizes[p.part];
  return {(p.width - size.x * p.scale) / 2, (p.height - size.y * p.scale) / 2};
}

void Packer::draw(const Piece& p, Bitmap& to) const {
  to.reset(p.width, p.height);
  const Charts& c = *items_[p.item].charts;
  Point2 o = offset(p);
  for (std::uint32_t i = c.begin[p.part]; i < c.begin[p.part + 1]; ++i) {
    const Point2f* t = &c.places[3 * std::size_t{c.triangles[i]}];
    to.add(Triangle2{o + p.scale * Point2{t[0].x, t[0].y}, o + p.scale * Point2{t[1].x, t[1].y},
                     o + p.scale * Point2{t[2].x, t[2].y}});
  }
}

/// The charts of an item that has copies, packed by themselves. When not even a texel for each fits into a page, those
/// beyond share the first.
void Packer::make_unit(std::uint32_t item, double factor, int side) {
  for (;; factor *= 0.9, shrunk_ = true) {
    std::vector<Piece> pieces;
    double area = 0;
    int widest = 1;
    for (std::uint32_t c = 0; c < items_[item].charts->size(); ++c) {
      Piece p = chart_piece(item, c, factor, side);
      area += double(p.width + options_.padding) * (p.height + options_.padding);
      widest = std::max({widest, p.width, p.height});
      pieces.push_back(p);
    }
    sort(pieces);
    Strip strip(std::clamp(static_cast<int>(std::sqrt(area)), widest, side), 0, options_.padding);
    std::vector<Spotted> spots;
    Filler filler(strip);
    for (const Piece& p : pieces) {
      check_stop();
      draw(p, bitmap_);
      spots.push_back(filler.place(bitmap_));
    }
    if (strip.top() > side && widest > 1) continue;
    units_[item].reset(strip.width(), std::min(strip.top(), side));
    for (std::size_t i = 0; i < pieces.size(); ++i) add_to_unit(pieces[i], spots[i], units_[item]);
    return;
  }
}

void Packer::add_to_unit(const Piece& p, Spotted s, Bitmap& unit) {
  if (s.at.y >= unit.height()) {
    s.at = {};
    atlas_.items[p.item].crowded = true;
  }
  draw(p, bitmap_);
  Bitmap turned;
  for (int q = 0; q < s.quarters; ++q) {
    turn_quarter(bitmap_, turned);
    std::swap(bitmap_, turned);
  }
  unit.add(bitmap_, s.at.x, s.at.y);
  atlas_.items[p.item].charts[p.part] = placement(p, s, offset(p));
}

std::vector<Piece> Packer::make_pieces(double factor, int side) {
  std::vector<Piece> pieces;
  for (std::uint32_t i = 0; i < items_.size(); ++i) {
    auto n = static_cast<std::uint32_t>(items_[i].charts->size());
    atlas_.items[i].charts.resize(n);
    atlas_.items[i].crowded = false;
    if (items_[i].copies > 1) {
      make_unit(i, factor, side);
      atlas_.items[i].copies.resize(items_[i].copies);
      for (std::uint32_t k = 0; k < items_[i].copies && n > 0; ++k)
        pieces.push_back({i, k, true, units_[i].width(), units_[i].height(), 1});
    } else {
      for (std::uint32_t c = 0; c < n; ++c) pieces.push_back(chart_piece(i, c, factor, side));
    }
  }
  sort(pieces);
  return pieces;
}

int Packer::run(double factor, int width, int height) {
  atlas_.factor = factor;
  atlas_.items.resize(items_.size());
  shrunk_ = false;
  std::vector<Piece> pieces = make_pieces(factor, width);
  Strip strip(width, height, options_.padding);
  Filler filler(strip);
  for (const Piece& p : pieces) {
    check_stop();
    if (!p.whole) draw(p, bitmap_);
    Spotted s = filler.place(p.whole ? units_[p.item] : bitmap_);
    std::uint32_t page = height > 0 ? s.at.y / height : 0;
    if (height > 0) s.at.y %= height;
    auto& list = p.whole ? atlas_.items[p.item].copies : atlas_.items[p.item].charts;
    list[p.part] = placement(p, s, offset(p));
    list[p.part].page = page;
  }
  int n = height > 0 ? std::max(1, (strip.top() + height - 1) / height) : 1;
  atlas_.pages.assign(n, {width, height > 0 ? height : strip.top()});
  return strip.top();
}

/// The factor at which the boxes, with the padding around them, would fill that share of the page.
double first_factor(const Packer& p, int side, int padding, double share) {
  double a = p.area(), b = p.perimeter() * (padding + 0.5), c = p.pieces() * padding * padding - share * side * side;
  if (!(a > 0)) return 1;
  return std::max((-b + std::sqrt(std::max(0., b * b - 4 * a * c))) / (2 * a), 1e-3 * side / std::sqrt(a));
}

/// Raises and lowers the factor until the strip is filled to the page's height.
Atlas fit(Packer& p, const PackOptions& options) {
  constexpr double full = 0.99, near = 1.004, few = 500;
  int tries = !(p.area() > 0) ? 1 : p.pieces() < few ? 10 : 5;  // few fill a page less evenly, but take no time
  double side = options.side, low = 0, high = 0, most = p.longest() > 0 ? side / p.longest() : HUGE_VAL;
  double pages = p.pieces() * (options.padding + 1) * (options.padding + 1) / (side * side);  // with a texel for each
  double f = std::min(most, first_factor(p, options.side, options.padding, pages < 1 ? 1 : std::ceil(2 * pages)));
  Atlas best;
  for (int k = 0; pages < 1 && (k < tries || (low == 0 && k < 4 * tries)); ++k) {
    double top = p.run(f, options.side, 0);
    if (p.shrunk()) top = std::max(top, 1.2 * side);
    if (top <= side) {
      low = f;
      best = p.atlas();
    } else
      high = f;
    if (low == f && (top > full * side || f >= most)) break;
    if (low > 0 && high > 0 && high < low * near) break;
    double next = f * std::sqrt(0.999 * side / top);
    if (low > 0 && next <= low) next = high > 0 ? (low + high) / 2 : low * 1.005;
    if (high > 0 && next >= high) next = low > 0 ? (low + high) / 2 : high * 0.98;
    f = std::min(next, most);
  }
  if (best.pages.empty()) {
    p.run(f, options.side, options.side);
    best = p.atlas();
  }
  for (Page& page : best.pages) page.height = options.side;
  return best;
}

int power_of_two(double n) {
  return static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::max(1., std::ceil(n)))));
}

/// One page if it can be, as small as can be; otherwise pages of the largest side.
Atlas fill(Packer& p, const PackOptions& options) {
  double texels = p.area() + p.perimeter() * (options.padding + 0.5) + p.pieces() * options.padding * options.padding;
  double wanted = std::max(std::sqrt(texels), p.longest()), most = options.max_side;
  int side = wanted < most ? std::min(options.max_side, power_of_two(wanted)) : options.max_side;
  int top = p.run(1, side, side);
  while (top > side && side < options.max_side) {
    side = std::min(2 * side, options.max_side);
    top = p.run(1, side, side);
  }
  Atlas atlas = p.atlas();
  int rest = top - side * static_cast<int>(atlas.pages.size() - 1);
  atlas.pages.back().height = std::min(side, power_of_two(rest));
  return atlas;
}

}  // namespace

Point2 Placement::apply(Point2 p) const { return turned(scale * p, quarter_turns) + Point2{x, y}; }

Atlas pack(std::span<const PackItem> items, const PackOptions& options) {
  Packer p(items, options);
  return options.side > 0 ? fit(p, options) : fill(p, options);
}

}  // namespace wrlkit::unwrap
