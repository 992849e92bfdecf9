#include "geometry/simplify/allocation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/parallel.h"

namespace wrlkit::simplify {
namespace {

constexpr double usual_peak = 8;    // largest distance over the root of the mean square, beyond which it is dearer
constexpr double least_rms = 1e-6;  // of the root of the area
constexpr double growth = 1.1;      // of the root of the mean square, after which all is priced again

}  // namespace

Allocation::Allocation(const std::vector<AllocatedPart>& parts, const Neighbours& neighbours, double area)
    : parts_(parts),
      neighbours_(neighbours),
      area_(area),
      at_(parts.size()),
      hull_(parts.size()),
      leaving_(parts.size()),
      outdated_(parts.size()),
      dependents_(parts.size()),
      orphans_(parts.size()) {
  for (std::uint32_t i = 0; i < parts.size(); ++i)
    for (auto owner : parts[i].places) {
      if (owner >= part_of_.size()) part_of_.resize(owner + std::size_t{1});
      part_of_[owner] = i;
    }
  std::vector<std::vector<std::uint32_t>> near(parts.size());
  parallel_for(parts.size(), [&](std::size_t i) {
    hull_[i] = convex_hull(*parts[i].rungs);
    leaving_[i] = price_of_leaving(static_cast<std::uint32_t>(i), near[i]);
  });
  for (std::uint32_t i = 0; i < parts.size(); ++i) depend(i, near[i]);
  for (std::uint32_t i = 0; i < parts.size(); ++i) n_drawn_ += (*parts[i].rungs)[0].n_faces * parts[i].places.size();
  price_all();
}

/// When larger distances have become usual.
void Allocation::price_all() {
  priced_at_ = std::max(rms(), least_rms * std::sqrt(area_));
  queue_ = {};
  for (std::uint32_t i = 0; i < parts_.size(); ++i)
    if (at_[i] != gone) queue_.push(next_of(i));
}

double Allocation::rms() const { return area_ > 0 ? std::sqrt(std::max(squares_, 0.) / (2 * area_)) : 0; }

double Allocation::key_of(double slope, double max) const {
  const double over = max / (usual_peak * priced_at_);
  return slope * std::max(1., over * over);
}

/// The cheapest way down from where a part stands.
Allocation::Step Allocation::next_of(std::uint32_t part) {
  const auto& p = parts_[part];
  const auto& rung = (*p.rungs)[at_[part]];
  const double places = static_cast<double>(p.places.size()), now = p.weight * rung.distortion.squares;
  const double all = places * static_cast<double>(rung.n_faces);
  Step best{key_of((leaving_[part].squares - now) / all, leaving_[part].max), part, gone};
  for (auto h : hull_[part]) {
    if (h <= at_[part]) continue;
    const auto& lower = (*p.rungs)[h];
    const double saved = places * static_cast<double>(rung.n_faces - lower.n_faces);
    const double key = key_of((p.weight * lower.distortion.squares - now) / saved, lower.distortion.max);
    if (key < best.key) best = {key, part, static_cast<std::uint32_t>(h)};
  }
  return best;
}

Neighbours::Found Allocation::nearest_left(const Vec3& p, std::uint32_t without) const {
  return neighbours_.nearest(p, std::numeric_limits<double>::infinity(), [&](std::uint32_t owner) {
    const auto part = part_of_[owner];
    return part != without && at_[part] != gone;
  });
}

double Allocation::squared_of(const LeavingSample& s, std::uint32_t look, const Neighbours::Found& found) const {
  const double squared = found.distance * found.distance;
  const bool same = found.owner != ClosestPoint::no_guess && parts_[part_of_[found.owner]].look == look;
  return same ? squared : std::max(squared, s.least);
}

/// Of its own points, and of those that left before and are near to it.
Allocation::Price Allocation::price_of_leaving(std::uint32_t part, std::vector<std::uint32_t>& near) const {
  Price out;
  auto add = [&](const LeavingSample& s, std::uint32_t look, double before) {
    const auto found = nearest_left(s.point, part);
    out.squares += s.weight * (squared_of(s, look, found) - before);
    out.max = std::max(out.max, found.distance);
    if (found.owner != ClosestPoint::no_guess) near.push_back(part_of_[found.owner]);
  };
  for (const auto& s : parts_[part].leaving) add(s, parts_[part].look, 0);
  for (const auto& o : orphans_[part]) add(o.sample, o.look, o.squared);
  return out;
}

void Allocation::depend(std::uint32_t part, std::vector<std::uint32_t>& near) {
  std::ranges::sort(near);
  near.erase(std::unique(near.begin(), near.end()), near.end());
  for (auto n : near) dependents_[n].push_back(part);
}

/// Again if one of those that it was near to has left.
void Allocation::price_leaving(std::uint32_t part) {
  if (!outdated_[part]) return;
  std::vector<std::uint32_t> near;
  leaving_[part] = price_of_leaving(part, near);
  depend(part, near);
  outdated_[part] = 0;
}

void Allocation::leave(std::uint32_t part) {
  at_[part] = gone;
  ++n_gone_;
  for (auto d : std::exchange(dependents_[part], {})) outdated_[d] = 1;
  auto attach = [&](const LeavingSample& s, std::uint32_t look) {
    const auto found = nearest_left(s.point, part);
    if (found.owner == ClosestPoint::no_guess) return;
    const auto near = part_of_[found.owner];
    orphans_[near].push_back({s, look, squared_of(s, look, found)});
    outdated_[near] = 1;
  };
  for (const auto& s : parts_[part].leaving) attach(s, parts_[part].look);
  for (const auto& o : std::exchange(orphans_[part], {})) attach(o.sample, o.look);
}

void Allocation::take(const Step& step) {
  const auto& p = parts_[step.part];
  const auto& rung = (*p.rungs)[at_[step.part]];
  squares_ -= p.weight * rung.distortion.squares;
  n_drawn_ -= p.places.size() * rung.n_faces;
  if (step.to == gone) {
    squares_ += leaving_[step.part].squares;
    max_ = std::max(max_, leaving_[step.part].max);
    leave(step.part);
    return;
  }
  const auto& lower = (*p.rungs)[step.to];
  squares_ += p.weight * lower.distortion.squares;
  max_ = std::max(max_, lower.distortion.max);
  n_drawn_ += p.places.size() * lower.n_faces;
  at_[step.part] = step.to;
  queue_.push(next_of(step.part));
}

bool Allocation::run_to(std::size_t n_drawn) {
  while (n_drawn_ > n_drawn) {
    if (rms() > growth * priced_at_) price_all();
    if (queue_.empty()) return false;
    const Step step = queue_.top();
    queue_.pop();
    if (!std::isfinite(step.key)) return false;  // nothing would be left
    // Others have left since, and larger distances have become usual.
    if (step.to == gone) price_leaving(step.part);
    const Step now = next_of(step.part);
    if (!queue_.empty() && queue_.top() < now) {
      if (queue_.top().key < now.key) {
        queue_.push(now);
        continue;
      }
    }
    if (now.to == gone && step.to != gone) {
      queue_.push(now);
      continue;
    }
    take(now);
  }
  return true;
}

}  // namespace wrlkit::simplify
