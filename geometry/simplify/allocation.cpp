#include "geometry/simplify/allocation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/parallel.h"

namespace wrlkit::simplify {
namespace {

constexpr double usual_peak = 3;    // largest distance over the root of the mean square, beyond which it is dearer
constexpr double least_rms = 1e-6;  // of the root of the area
constexpr std::size_t asked_at_once = 64;   // parts
constexpr std::size_t chunk = 128;          // samples that are asked one after another
constexpr std::uint32_t most_orphans = 64;  // of a part
constexpr std::size_t small_rest = 100;     // of the triangles, that are not given back
constexpr double growth = 1.1;              // of the root of the mean square, after which all is priced again

}  // namespace

Allocation::Allocation(std::vector<AllocatedPart>& parts, Neighbours& neighbours, double area)
    : parts_(parts),
      neighbours_(neighbours),
      area_(area),
      at_(parts.size()),
      stops_(parts.size()),
      leaving_(parts.size()),
      n_orphans_(parts.size()) {
  for (std::uint32_t i = 0; i < parts.size(); ++i) {
    part_of_.insert(part_of_.end(), parts[i].n_owners, i);
    n_drawn_ += (*parts[i].rungs)[0].n_faces * parts[i].n_places;
  }
  parallel_for(parts.size(), [&](std::size_t i) {
    list_stops(static_cast<std::uint32_t>(i));
    price_leaving(static_cast<std::uint32_t>(i));
  });
  price_all();
}

void Allocation::list_stops(std::uint32_t part) {
  for (const auto rung : convex_hull(*parts_[part].rungs, parts_[part].stretch))
    stops_[part].push_back(stop_at(part, rung));
}

Allocation::Stop Allocation::stop_at(std::uint32_t part, std::uint32_t rung) const {
  const auto& p = parts_[part];
  const auto& d = (*p.rungs)[rung].distortion;
  const double max = p.stretch.max(d);
  return {rung, {p.stretch.squares(d), max, max}};
}

/// When larger distances have become usual.
void Allocation::price_all() {
  priced_at_ = std::max(rms(), least_rms * std::sqrt(area_));
  queue_ = {};
  for (std::uint32_t i = 0; i < parts_.size(); ++i)
    if (at_[i] != gone) queue_.push(next_of(i));
}

double Allocation::rms() const { return area_ > 0 ? std::sqrt(std::max(squares_, 0.) / (2 * area_)) : 0; }

std::vector<std::uint32_t> Allocation::rungs() const {
  std::vector<std::uint32_t> out(at_.size(), gone);
  for (std::size_t i = 0; i < at_.size(); ++i)
    if (at_[i] != gone) out[i] = stops_[i][at_[i]].rung;
  return out;
}

std::vector<double> Allocation::maxima() const {
  std::vector<double> out;
  for (std::size_t i = 0; i < at_.size(); ++i)
    out.push_back(at_[i] == gone ? leaving_[i].max : stops_[i][at_[i]].price.max);
  return out;
}

double Allocation::key_of(double slope, double peak) const {
  const double over = peak / (usual_peak * priced_at_);
  return slope * std::max(1., over * over);
}

/// The cheapest way down from where a part stands.
Allocation::Step Allocation::next_of(std::uint32_t part) const {
  const auto& p = parts_[part];
  const auto& stops = stops_[part];
  const auto& now = stops[at_[part]];
  const double places = static_cast<double>(p.n_places);
  const auto n_faces = [&](std::uint32_t stop) { return (*p.rungs)[stops[stop].rung].n_faces; };
  const double all = places * static_cast<double>(n_faces(at_[part]));
  Step best{key_of((leaving_[part].squares - now.price.squares) / all, leaving_[part].peak), part, gone};
  for (std::uint32_t i = at_[part] + 1; i < stops.size(); ++i) {
    const double saved = places * static_cast<double>(n_faces(at_[part]) - n_faces(i));
    const double key = key_of((stops[i].price.squares - now.price.squares) / saved, stops[i].price.peak);
    if (key < best.key) best = {key, part, i};
  }
  return best;
}

/// Whether what it was near to has left.
bool Allocation::must_ask(const LeavingSample& s) const {
  return !s.is_asked || (s.near != ClosestPoint::no_guess && !neighbours_.is_left(s.near));
}

double Allocation::squared_of(const LeavingSample& s) const {
  const double squared = s.distance * s.distance;
  const bool same = s.near != ClosestPoint::no_guess && parts_[part_of_[s.near]].look == s.look;
  return same ? squared : std::max(squared, s.least);
}

/// What is nearest to those of the samples that do not know.
void Allocation::ask(std::span<LeavingSample> samples, std::uint32_t part) const {
  const auto first = parts_[part].first_owner, end = first + parts_[part].n_owners;
  auto guess = ClosestPoint::no_guess;
  for (auto& s : samples) {
    if (!must_ask(s)) continue;
    const auto found = neighbours_.nearest(s.point, std::numeric_limits<double>::infinity(), {first, end}, guess);
    guess = found.triangle;
    s.near = found.owner;
    s.distance = found.distance;
    s.is_asked = true;
  }
}

/// Of its own points, and of those that left before and are near to it.
void Allocation::price_leaving(std::uint32_t part) {
  const std::span<LeavingSample> all = parts_[part].leaving;
  const auto n_chunks = (all.size() + chunk - 1) / chunk;
  parallel_for(n_chunks,
               [&](std::size_t i) { ask(all.subspan(i * chunk, std::min(chunk, all.size() - i * chunk)), part); });
  Price out;
  for (const auto& s : all) {
    const double squared = squared_of(s);
    out.squares += s.weight * (squared - s.counted);
    out.max = std::max(out.max, s.distance);
    out.peak = std::max(out.peak, squared);
  }
  out.peak = std::sqrt(out.peak);
  leaving_[part] = out;
}

bool Allocation::is_outdated(const Step& step) const {
  return step.to == gone &&
         std::ranges::any_of(parts_[step.part].leaving, [&](const LeavingSample& s) { return must_ask(s); });
}

/// The price of leaving of a part, and of the next that will be asked for: the threads share the work.
void Allocation::price_next(const Step& first) {
  std::vector<Step> steps;
  std::vector<std::uint32_t> outdated{first.part};
  while (!queue_.empty() && steps.size() < asked_at_once) {
    steps.push_back(queue_.top());
    queue_.pop();
    if (is_outdated(steps.back())) outdated.push_back(steps.back().part);
  }
  parallel_for(outdated.size(), [&](std::size_t i) { price_leaving(outdated[i]); });
  for (const Step& s : steps) queue_.push(next_of(s.part));
}

/// Where there are many, every other one counts for the next, too.
void Allocation::attach(std::uint32_t part, const LeavingSample& s) {
  auto& all = parts_[part].leaving;
  auto& n = n_orphans_[part];
  if (n == most_orphans) {
    const auto first = all.size() - n;
    for (std::size_t i = 0; i < most_orphans / 2; ++i) {
      const double weight = all[first + 2 * i].weight + all[first + 2 * i + 1].weight;
      all[first + i] = all[first + 2 * i];
      all[first + i].weight = weight;
    }
    n = most_orphans / 2;
    all.resize(first + n);
  }
  auto& added = all.emplace_back(s);
  added.counted = squared_of(s);
  added.is_asked = false;
  ++n;
}

void Allocation::leave(std::uint32_t part) {
  const auto& p = parts_[part];
  at_[part] = gone;
  ++n_gone_;
  neighbours_.leave(p.first_owner, p.first_owner + p.n_owners);
  for (const auto& s : std::exchange(parts_[part].leaving, {}))
    if (s.near != ClosestPoint::no_guess) attach(part_of_[s.near], s);
}

/// The number of a rung among the stops of a part, where it becomes one.
std::uint32_t Allocation::stop_of(std::uint32_t part, std::uint32_t rung) {
  auto& stops = stops_[part];
  const auto next = std::ranges::lower_bound(stops, rung, {}, &Stop::rung);
  const auto number = static_cast<std::uint32_t>(next - stops.begin());
  if (next == stops.end() || next->rung != rung) stops.insert(next, stop_at(part, rung));
  return number;
}

/// Where a step saves more than is asked for, another one may do that adds less: of each part the first rung with which
/// the world has few enough triangles, on the hull or off it.
Allocation::Step Allocation::last_step(const Step& step, std::size_t n_drawn) {
  const auto saved_by = [&](const AllocatedPart& p, std::uint32_t now, std::uint32_t rung) {
    return p.n_places * ((*p.rungs)[now].n_faces - (*p.rungs)[rung].n_faces);
  };
  const auto needed = n_drawn_ - n_drawn;
  const auto& first = parts_[step.part];
  const auto& from = stops_[step.part][at_[step.part]];
  const auto saved = step.to == gone ? first.n_places * (*first.rungs)[from.rung].n_faces
                                     : saved_by(first, from.rung, stops_[step.part][step.to].rung);
  if (saved <= needed) return step;
  double least = step.key * static_cast<double>(saved);
  auto best = std::pair{step.part, step.to == gone ? gone : stops_[step.part][step.to].rung};
  for (std::uint32_t i = 0; i < parts_.size(); ++i) {
    if (at_[i] == gone) continue;
    const auto& p = parts_[i];
    const auto& now = stops_[i][at_[i]];
    auto rung = now.rung + 1;
    while (rung < p.rungs->size() && saved_by(p, now.rung, rung) < needed) ++rung;
    if (rung == p.rungs->size()) continue;
    const auto price = stop_at(i, rung).price;
    const double cost = key_of(price.squares - now.price.squares, price.peak);
    if (cost >= least) continue;
    least = cost;
    best = {i, rung};
  }
  return {step.key, best.first, best.second == gone ? gone : stop_of(best.first, best.second)};
}

void Allocation::take(const Step& step) {
  const auto& p = parts_[step.part];
  const auto& stops = stops_[step.part];
  const auto& now = stops[at_[step.part]];
  squares_ -= now.price.squares;
  n_drawn_ -= p.n_places * (*p.rungs)[now.rung].n_faces;
  if (step.to == gone) {
    squares_ += leaving_[step.part].squares;
    max_ = std::max(max_, leaving_[step.part].max);
    leave(step.part);
    return;
  }
  const auto& lower = stops[step.to];
  squares_ += lower.price.squares;
  max_ = std::max(max_, lower.price.max);
  n_drawn_ += p.n_places * (*p.rungs)[lower.rung].n_faces;
  at_[step.part] = step.to;
}

/// The step up from where a part stands that is worth most to each triangle, of those that can be had.
std::optional<Allocation::Raise> Allocation::raise_of(std::uint32_t part, std::uint32_t highest,
                                                      std::size_t n_spare) const {
  const auto& p = parts_[part];
  const auto& now = stops_[part][at_[part]];
  std::optional<Raise> best;
  for (auto rung = now.rung; rung-- > highest;) {
    const auto cost = p.n_places * ((*p.rungs)[rung].n_faces - (*p.rungs)[now.rung].n_faces);
    if (cost > n_spare) break;
    if (cost == 0) continue;
    const double squares = now.price.squares - stop_at(part, rung).price.squares;
    const double gain = key_of(squares / static_cast<double>(cost), now.price.peak);
    if (gain > (best ? best->gain : 0)) best = {gain, part, rung};
  }
  return best;
}

void Allocation::give_back(std::size_t n_spare, const std::vector<std::uint32_t>& highest) {
  std::priority_queue<Raise> raises;
  const auto look_at = [&](std::uint32_t part) {
    if (at_[part] == gone || stops_[part][at_[part]].rung == highest[part]) return;
    if (const auto raise = raise_of(part, highest[part], n_spare)) raises.push(*raise);
  };
  for (std::uint32_t i = 0; i < parts_.size(); ++i) look_at(i);
  bool has_raised = false;
  while (!raises.empty()) {
    const auto raise = raises.top();
    raises.pop();
    const auto now = raise_of(raise.part, highest[raise.part], n_spare);  // others have been raised since
    if (!now) continue;
    if (now->gain < raise.gain) {
      raises.push(*now);
      continue;
    }
    const auto before = n_drawn_;
    const auto n_stops = stops_[now->part].size();
    const auto to = stop_of(now->part, now->rung);
    if (stops_[now->part].size() > n_stops) ++at_[now->part];
    take({0, now->part, to});
    n_spare -= n_drawn_ - before;
    has_raised = true;
    look_at(now->part);
  }
  if (!has_raised) return;
  const auto all = maxima();
  max_ = *std::ranges::max_element(all);
  price_all();
}

bool Allocation::run_to(std::size_t n_drawn) {
  const auto before = rungs();
  const bool is_reached = step_down_to(n_drawn);
  if (is_reached && n_drawn - n_drawn_ > n_drawn / small_rest) give_back(n_drawn - n_drawn_, before);
  return is_reached;
}

bool Allocation::step_down_to(std::size_t n_drawn) {
  while (n_drawn_ > n_drawn) {
    if (rms() > growth * priced_at_) price_all();
    if (queue_.empty()) return false;
    const Step step = queue_.top();
    queue_.pop();
    if (!std::isfinite(step.key)) return false;  // nothing would be left
    // Others have left since, and larger distances have become usual.
    if (is_outdated(step)) price_next(step);
    const Step now = next_of(step.part);
    if (!std::isfinite(now.key)) continue;
    // Of steps, the cheaper one is the larger.
    const bool another_is_cheaper = !queue_.empty() && now < queue_.top();
    if (another_is_cheaper || (now.to == gone && step.to != gone)) {
      queue_.push(now);
      continue;
    }
    take(last_step(now, n_drawn));  // which may be one of another part, whose own step waits
    if (at_[now.part] != gone) queue_.push(next_of(now.part));
  }
  return true;
}

}  // namespace wrlkit::simplify
