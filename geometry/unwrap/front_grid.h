// Whether a triangle would overlap a chart. Only triangles at the chart's rim are asked: what overlaps the inside has
// crossed the rim before, because charts grow triangle by triangle.
#pragma once
#include <cstdint>
#include <vector>

#include "geometry/unwrap/rows.h"

namespace wrlkit::unwrap {

/// Whether the two have an inner point in common, by more than rounding.
bool overlap(const Triangle2& a, const Triangle2& b);

class FrontGrid {
 public:
  /// Forgets everything; cells will be that wide. `n` triangles are expected.
  void reset(double cell, std::size_t n);
  /// Adds a triangle under a name.
  void insert(const Triangle2& t, std::uint32_t name);

  /// Whether `t` overlaps one of the triangles. `get(name, triangle)` gives what lies under that name, false: it is not
  /// at the rim any more and is forgotten.
  template <class Get>
  bool overlaps(const Triangle2& t, Get&& get) {
    bool found = false;
    int n = 0;
    ++query_;
    for_each_touched_row(scaled(t), [&](int y, int x0, int x1) {
      for (int x = x0; x <= x1 && !found; ++x)
        for (std::uint32_t* link = &head_[bucket(x, y)]; *link != end;) {
          Triangle2 other;
          Entry& e = entries_[*link];
          found |= ++n > most_asked;
          if (found) break;
          if (asked_[e.name] == query_) {
            link = &e.next;
            continue;
          }
          asked_[e.name] = query_;
          if (!get(e.name, other)) {
            *link = e.next;
            continue;
          }
          found |= overlap(t, other);
          link = &e.next;
        }
    });
    return found;
  }

 private:
  static constexpr int most_asked = 8192;
  static constexpr std::uint32_t end = 0xffffffffu;
  struct Entry {
    std::uint32_t name, next;
  };
  Triangle2 scaled(const Triangle2& t) const { return {scale_ * t[0], scale_ * t[1], scale_ * t[2]}; }
  std::size_t bucket(int x, int y) const {
    return (static_cast<std::uint32_t>(x) * 0x9E3779B1u ^ static_cast<std::uint32_t>(y) * 0x85EBCA77u) >> shift_;
  }

  std::vector<std::uint32_t> asked_;  // of a name: the last query that met it
  std::uint32_t query_ = 0;
  double scale_ = 1;
  int shift_ = 31;
  std::vector<std::uint32_t> head_;
  std::vector<Entry> entries_;
};

}  // namespace wrlkit::unwrap
