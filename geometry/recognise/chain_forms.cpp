#include "geometry/recognise/chain_forms.h"

#include <algorithm>
#include <array>

#include "base/math/vec.h"
#include "geometry/recognise/fits.h"

namespace wrlkit::recognising {
namespace {

/// Rings with the faces between them, apices counted as rings.
struct Run {
  std::vector<Ring> rings;
  std::vector<std::vector<std::uint32_t>> bands;  // one fewer than rings
  std::vector<std::uint32_t> first_cap, last_cap;
  bool closed = false;

  void reverse() {
    std::ranges::reverse(rings);
    std::ranges::reverse(bands);
    std::swap(first_cap, last_cap);
  }
};

Run run_of(const Piece& p, const Chain& chain, const Tolerances& tolerances) {
  Run run;
  const std::size_t n = chain.rings[0].size();
  run.bands = chain.bands;
  run.closed = chain.last == ChainEnd::closed;
  if (chain.first == ChainEnd::apex) {
    run.rings.push_back(apex_of(p.points[chain.first_apex], n));
    run.bands.insert(run.bands.begin(), chain.first_faces);
  } else {
    run.first_cap = chain.first_faces;
  }
  for (std::size_t k = 0; k + (run.closed ? 1 : 0) < chain.rings.size(); ++k) {
    std::vector<Vec3> at;
    for (auto i : chain.rings[k]) at.push_back(p.points[i]);
    run.rings.push_back(ring_of(std::move(at), tolerances));
  }
  if (chain.last == ChainEnd::apex) {
    run.rings.push_back(apex_of(p.points[chain.last_apex], n));
    run.bands.push_back(chain.last_faces);
  } else {
    run.last_cap = chain.last_faces;
  }
  return run;
}

using Rings = std::span<const Ring>;

/// How far from ring i on the rings are in a row, as a pipe or a cone has them: the last of them.
std::size_t straight_until(Rings rings, std::size_t i, double tolerance) {
  std::size_t j = i + 1;
  const Vec3 first = rings[j].centre - rings[i].centre;
  const double step = length(first);
  for (; j + 1 < rings.size(); ++j) {
    const Vec3 here = rings[j + 1].centre - rings[i].centre;
    const double l = length(here);
    if (!(l > 0) || !(dot(here, first) > 0)) break;
    const double along = dot(first, here) / l;
    if (length(first - (along / l) * here) > tolerance) break;
    const double expected = rings[i].radius + (rings[j + 1].radius - rings[i].radius) * along / l;
    if (std::abs(expected - rings[j].radius) > tolerance || step == 0) break;
    if (dot(rings[j + 1].centre - rings[j].centre, first) <= 0) break;
    const Vec3 normal = rings[j].apex ? rings[i].normal : rings[j].normal;
    if (!rings[j + 1].apex && length(cross(normal, rings[j + 1].normal)) * rings[j + 1].radius > 2 * tolerance) break;
  }
  return j;
}

/// How far the rings turn evenly.
std::size_t bent_until(Rings rings, std::size_t i, double tolerance) {
  std::size_t j = i + 1;
  if (rings[i].apex || rings[j].apex) return j;
  const Vec3 turn = cross(rings[i].normal, rings[j].normal);
  for (; j + 1 < rings.size() && !rings[j + 1].apex; ++j) {
    const Vec3 next = cross(rings[j].normal, rings[j + 1].normal);
    if (length(next - turn) * rings[i].radius > 3 * tolerance) break;
    const double a = length(rings[i + 1].centre - rings[i].centre), b = length(rings[j + 1].centre - rings[j].centre);
    if (std::abs(a - b) > 3 * tolerance || std::abs(rings[j + 1].radius - rings[i].radius) > tolerance) break;
  }
  return j;
}

class Reader {
 public:
  Reader(Run run, const Tolerances& tolerances) : run_(std::move(run)), t_(tolerances) {}

  Reading read() {
    if (!whole()) in_pieces();
    return std::move(out_);
  }

 private:
  Rings part(std::size_t i, std::size_t j) const { return Rings(run_.rings).subspan(i, j - i + 1); }

  /// The rings i to j as one form.
  bool take(std::size_t i, std::size_t j, std::optional<Fit> fit) {
    if (!fit) return false;
    RecognisedForm found{std::move(fit->form), {}, fit->residual, !fit->outward};
    for (std::size_t k = i; k < j; ++k) add(found.faces, run_.bands[k]);
    const bool first = i == 0 && !run_.first_cap.empty(), last = j + 1 == run_.rings.size() && !run_.last_cap.empty();
    if (first) add(found.faces, run_.first_cap);
    if (last) add(found.faces, run_.last_cap);
    found.form.bottom = first;
    found.form.top = last;
    out_.n_faces += found.faces.size();
    out_.forms.push_back(std::move(found));
    return true;
  }
  static void add(std::vector<std::uint32_t>& to, const std::vector<std::uint32_t>& faces) {
    to.insert(to.end(), faces.begin(), faces.end());
  }

  bool whole();
  bool closed();
  bool flat();
  Vec3 swept() const;
  bool flat_torus();
  void in_pieces();
  std::size_t dish_at_end();
  std::size_t piece_at(std::size_t i, std::size_t end);

  Run run_;
  Tolerances t_;
  Reading out_;
};

bool Reader::closed() {
  const std::size_t last = run_.rings.size() - 1;
  auto fit = fit_torus(part(0, last), true, t_);
  if (!fit) fit = fit_closed_ring(part(0, last), t_);
  const bool ring = fit && std::holds_alternative<RingForm>(fit->form.shape);
  if (!take(0, last, std::move(fit))) return false;
  add(out_.forms[0].faces, run_.bands.back());
  out_.n_faces = out_.forms[0].faces.size();
  if (ring) out_.forms[0].form.bottom = out_.forms[0].form.top = true;
  return true;
}

/// Rectangles that turn around an axis; open ends are distinguished from closed ones.
bool Reader::flat_torus() {
  const std::size_t n = run_.rings.size();
  if (n < 3 || run_.rings[0].at.size() != 4 || run_.rings.back().apex) return false;
  for (std::size_t shift : {0, 1}) {  // the flat sides are columns 0-1 and 2-3, or 1-2 and 3-0
    std::vector<Vec3> low, high;
    for (std::size_t side : {0, 1})
      for (std::size_t k = 0; k < n; ++k) {
        const Ring& r = run_.rings[side ? n - 1 - k : k];
        low.push_back(r.at[(side ? 1 + shift : shift) % 4]);
        high.push_back(r.at[(side ? 2 + shift : 3 + shift) % 4]);
      }
    const Ring rings[] = {ring_of(low, t_), ring_of(high, t_)};
    auto fit = fit_prism(rings, t_);
    if (!fit || !std::holds_alternative<RectangularTorusForm>(fit->form.shape)) continue;
    // Whether the walls point outwards is seen from the columns, as everywhere: against the walk.
    const Ring& first = run_.rings.front();
    fit->outward = dot(first.normal, run_.rings[1].centre - first.centre) > 0;
    return take(0, n - 1, std::move(fit));
  }
  return false;
}

/// Four walls written one after the other around the part and two caps behind them, as a cylinder of four sides is and
/// a box is not: the only way to tell them from each other. The direction from cap to cap; zero where it is not so.
Vec3 Reader::swept() const {
  const auto& walls = run_.bands[0];
  const auto& at = run_.rings[0].at;
  if (walls.size() != 4 || run_.first_cap.size() != 1 || run_.last_cap.size() != 1) return {};
  std::array<std::pair<std::uint32_t, int>, 6> sides;  // face and the axis that it is across
  for (std::size_t k = 0; k < 4; ++k) sides[k] = {walls[k], static_cast<int>(k % 2)};
  sides[4] = {run_.first_cap[0], 2};
  sides[5] = {run_.last_cap[0], 2};
  std::ranges::sort(sides);
  auto axis = [&](std::size_t k) { return sides[k].second; };
  const bool around = axis(0) == axis(2) && axis(1) == axis(3) && axis(0) != axis(1) && axis(4) == axis(5);
  if (!around) return {};
  const Vec3 directions[] = {at[2] - at[1], at[1] - at[0], run_.rings[1].centre - run_.rings[0].centre};
  return unit(directions[axis(4)]);
}

bool Reader::flat() {
  const std::size_t last = run_.rings.size() - 1, n = run_.rings[0].at.size();
  if (last == 1 && n == 4) {
    auto prism = fit_prism(part(0, 1), t_);
    const bool box = prism && std::holds_alternative<BoxForm>(prism->form.shape);
    if (box) become_square_bar(prism->form, swept(), t_.flat());
    if (box) return take(0, 1, std::move(prism));
    out_.rank = 1;
    if (take(0, 1, fit_pyramid(part(0, 1), t_))) return true;
    out_.rank = 2;
    return take(0, 1, std::move(prism));
  }
  if (flat_torus()) return true;
  if (run_.rings[0].round && n > 4) return false;
  if (!take(0, last, fit_prism(part(0, last), t_))) return false;
  out_.rank = std::holds_alternative<BoxForm>(out_.forms[0].form.shape) ? 0 : 2;
  // A sector was closed by its walls: its caps are among them.
  auto& form = out_.forms[0].form;
  if (std::holds_alternative<RectangularTorusForm>(form.shape)) {
    if (!form.bottom || !form.top) out_ = {};
    return !out_.forms.empty();
  }
  return true;
}

bool Reader::whole() {
  if (run_.closed) return closed();
  auto& rings = run_.rings;
  if (rings.front().apex && !rings.back().apex) run_.reverse();
  const std::size_t last = rings.size() - 1;
  if (last == 0) return false;
  if (rings.front().apex) return take(0, last, fit_sphere(part(0, last), t_));
  if (flat()) return true;
  return rings.back().apex && take(0, last, fit_dish(part(0, last), t_));
}

/// Where a dish begins that ends the run; the last ring when none does.
std::size_t Reader::dish_at_end() {
  const std::size_t last = run_.rings.size() - 1;
  if (!run_.rings.back().apex || last < 2) return last;
  for (std::size_t i = 0; i + 2 <= last; ++i)
    if (take(i, last, fit_dish(part(i, last), t_))) return i;
  return last;
}

std::size_t Reader::piece_at(std::size_t i, std::size_t end) {
  const auto rings = Rings(run_.rings).first(end + 1);
  const double tolerance = t_.round(std::max(rings[i].radius, rings[i + 1].radius), rings[i].at.size());
  std::size_t j = straight_until(rings, i, tolerance);
  if (take(i, j, fit_straight(part(i, j), t_))) return j;
  if (j > i + 1 && take(i, i + 1, fit_straight(part(i, i + 1), t_))) return i + 1;
  j = bent_until(rings, i, tolerance);
  if (take(i, j, fit_torus(part(i, j), false, t_))) return j;
  if (rings[i].at.size() < 5) return i;
  if (take(i, i + 1, fit_slanted(part(i, i + 1), t_)) || take(i, i + 1, fit_eccentric(part(i, i + 1), t_)))
    return i + 1;
  return i;
}

void Reader::in_pieces() {
  if (run_.closed) return;
  out_ = {};
  out_.rank = 3;
  const std::size_t end = dish_at_end();
  const auto dishes = std::move(out_.forms);
  out_.forms.clear();
  std::size_t missed = 0;
  for (std::size_t i = 0; i < end;) {
    const std::size_t j = piece_at(i, end);
    missed += j == i;
    i = std::max(j, i + 1);
  }
  out_.forms.insert(out_.forms.end(), dishes.begin(), dishes.end());
  // What falls to pieces ring by ring is not a run of forms but a turned part.
  const std::size_t n = out_.forms.size();
  if (missed > 0 || (n > 4 && 5 * n > 3 * run_.bands.size())) out_ = {};
}

Tolerances tolerances_of(const Piece& piece, const RecogniseOptions& options) {
  return {options.tolerance, piece.step, piece.size};
}

}  // namespace

Reading read_chain(const Piece& piece, const Chain& chain, const RecogniseOptions& options) {
  const auto tolerances = tolerances_of(piece, options);
  return Reader(run_of(piece, chain, tolerances), tolerances).read();
}

Reading read_hollow(const Piece& piece, const std::vector<Chain>& chains, const RecogniseOptions& options) {
  const auto tolerances = tolerances_of(piece, options);
  std::vector<Ring> low, high;
  RecognisedForm found;
  for (const Chain& c : chains) {
    if (c.rings.size() != 2 || c.last != ChainEnd::cap || c.last_region != chains[0].last_region) return {};
    for (bool top : {false, true}) {
      std::vector<Vec3> at;
      for (auto i : c.rings[top]) at.push_back(piece.points[i]);
      (top ? high : low).push_back(ring_of(std::move(at), tolerances));
    }
    found.faces.insert(found.faces.end(), c.bands[0].begin(), c.bands[0].end());
  }
  // The outer loop is the one that spans most.
  const auto outer = std::ranges::max_element(low, {}, &Ring::radius) - low.begin();
  std::swap(low[0], low[static_cast<std::size_t>(outer)]);
  std::swap(high[0], high[static_cast<std::size_t>(outer)]);
  auto fit = fit_hollow(low, high, tolerances);
  if (!fit) return {};
  for (const auto* cap : {&chains[0].first_faces, &chains[0].last_faces})
    found.faces.insert(found.faces.end(), cap->begin(), cap->end());
  found.form = std::move(fit->form);
  found.residual = fit->residual;
  found.inside_out = !fit->outward;
  Reading out;
  out.n_faces = found.faces.size();
  out.forms.push_back(std::move(found));
  return out;
}

}  // namespace wrlkit::recognising
