#include "passes/merge/place_tables.h"

#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include "passes/merge/gltf_cost.h"

namespace wrlkit {
namespace {

/// The places of one geometry in one look.
struct Sharing {
  std::uint32_t kind = 0, geometry = 0;
  std::vector<std::size_t> items;
  std::map<std::uint32_t, std::pair<std::size_t, std::uint32_t>> in_zone;  // places of a table; times it is drawn
  std::size_t odd = 0, odd_draws = 0;  // places that no table can express; they stay nodes
  double bytes = 0;
  bool kept = false;

  void add(std::size_t i, const TableItem& item) {
    kind = item.kind;
    geometry = item.geometry;
    bytes = item.bytes;
    items.push_back(i);
    if (item.fits) {
      auto& [places, times] = in_zone[item.zone];
      ++places;
      times = item.times;
    } else {
      ++odd;
      odd_draws += item.times;
    }
  }
  double n() const { return static_cast<double>(items.size()); }
  double merged() const { return n() * bytes; }
  double as_tables(double table) const {
    return table * static_cast<double>(in_zone.size()) + gltf_cost::place * (n() - static_cast<double>(odd)) +
           2 * gltf_cost::node * static_cast<double>(odd);
  }
  double saved() const { return merged() - gltf_cost::own_share * bytes - as_tables(gltf_cost::table); }
};

class Choice {
 public:
  Choice(std::span<const TableItem> items, std::size_t budget) : budget_(budget) {
    for (std::size_t i = 0; i < items.size(); ++i) {
      known_[{items[i].look, items[i].geometry}].add(i, items[i]);
      draws_of_kind_[items[i].kind] = items[i].times;
    }
    out_.kept.resize(items.size());
    for (const auto& [kind, times] : draws_of_kind_) draws_ += times;
  }

  PlaceTables run() {
    std::vector<Sharing*> best;
    for (auto& [key, s] : known_)
      if (s.saved() > 0) best.push_back(&s);
    std::ranges::stable_sort(best, std::greater{}, &Sharing::saved);
    for (Sharing* s : best) keep(*s);
    keep_rests();
    return std::move(out_);
  }

 private:
  void keep(Sharing& s) {
    std::size_t cost = s.odd_draws, saved = 0;
    for (const auto& [zone, n] : s.in_zone) {
      cost += n.second;
      saved += (n.first - 1) * n.second;
    }
    if (draws_ + cost > budget_) return;
    draws_ += cost;
    out_.saved_draws += saved;
    s.kept = true;
    for (auto i : s.items) out_.kept[i] = 1;
  }

  void keep_rests() {
    std::set<std::uint32_t> drawn;  // geometry that has a table
    std::map<std::uint32_t, std::vector<Sharing*>> rests;
    for (auto& [key, s] : known_)
      if (s.kept)
        drawn.insert(s.geometry);
      else
        rests[s.kind].push_back(&s);
    for (auto& [kind, rest] : rests) {
      double merged = gltf_cost::mesh + gltf_cost::node, tables = 0;
      for (const Sharing* s : rest) {
        merged += s->merged();
        tables += drawn.contains(s->geometry) ? s->as_tables(gltf_cost::table - gltf_cost::mesh) : merged;
      }
      if (tables >= merged) continue;
      draws_ -= draws_of_kind_[kind];
      for (Sharing* s : rest) keep(*s);
    }
  }

  std::map<std::pair<std::uint32_t, std::uint32_t>, Sharing> known_;
  std::map<std::uint32_t, std::size_t> draws_of_kind_;
  std::size_t draws_ = 0, budget_;
  PlaceTables out_;
};

}  // namespace

PlaceTables place_tables(std::span<const TableItem> items, std::size_t budget) { return Choice(items, budget).run(); }

}  // namespace wrlkit
