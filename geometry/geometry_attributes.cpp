#include "geometry/geometry_attributes.h"

#include <algorithm>
#include <cmath>

#include "geometry/geometry_lists.h"

namespace wrlkit {
namespace {

// One binding at work: fills the index of the attribute and remembers whether values ran short.
class Binder {
 public:
  Binder(MeshJob& job, Attribute& attribute, const AttributeBinding& binding, const AuthoredRuns& runs)
      : job_(job),
        mesh_(job.mesh),
        out_(attribute),
        from_(binding),
        runs_(runs),
        count_(binding.values.size() / static_cast<std::size_t>(attribute.width)) {}

  void bind() {
    if (count_ == 0 || mesh_.corners.empty()) return;
    if (!from_.per_vertex)
      bind_faces();
    else if (from_.index.empty())
      bind_positions();
    else if (!bind_aligned())
      bind_runs();
    if (count_ > mesh_.corners.size())
      copy_used_values();
    else
      copy_values();
    report();
  }

 private:
  // Index of a value that exists.
  std::uint32_t clamp(std::int64_t i) {
    if (i >= 0 && i < static_cast<std::int64_t>(count_)) return static_cast<std::uint32_t>(i);
    short_values_ = true;
    return i < 0 ? 0 : static_cast<std::uint32_t>(count_ - 1);
  }

  // Per vertex without a list: coordIndex is used.
  void bind_positions() {
    out_.index = mesh_.corners;
    if (count_ < mesh_.n_positions())
      for (auto& i : out_.index) i = clamp(i);
  }

  // Per vertex with a list that has its -1 where coordIndex has them: entry k belongs to entry k. False, and nothing
  // done, where it has not, and where faces were dropped.
  bool bind_aligned() {
    if (!runs_.dropped.empty()) return false;
    out_.index.resize(mesh_.corners.size());
    std::uint32_t* to = out_.index.data();
    const auto n = static_cast<std::uint32_t>(std::min<std::size_t>(count_, INT32_MAX));
    for (std::size_t k = 0; k < runs_.coordIndex.size(); ++k) {
      std::int32_t own = k < from_.index.size() ? from_.index[k] : -1;
      if (runs_.coordIndex[k] == -1) {
        if (own != -1) return false;
      } else {
        if (static_cast<std::uint32_t>(own) >= n) return false;
        *to++ = static_cast<std::uint32_t>(own);
      }
    }
    return true;
  }

  // Per vertex with any list: face by face. A list without a single -1 is taken as one entry a corner.
  void bind_runs() {
    out_.index.clear();
    auto own = from_.index;
    const bool flat = std::ranges::find(own, -1) == own.end();
    std::size_t number = 0, next = 0, at = 0;
    for_each_run(runs_.coordIndex, [&](std::size_t first, std::size_t last) {
      std::size_t end = at;
      if (flat)
        end = std::min(at + (last - first), own.size());
      else
        while (end < own.size() && own[end] != -1) ++end;
      if (next < runs_.dropped.size() && runs_.dropped[next] == number)
        ++next;
      else
        bind_run(own.subspan(at, end - at), last - first);
      ++number;
      at = std::min(flat ? end : end + 1, own.size());
    });
  }

  void bind_run(std::span<const std::int32_t> own, std::size_t n_corners) {
    short_index_ |= own.size() < n_corners;
    for (std::size_t i = 0; i < n_corners; ++i) {
      if (i < own.size()) last_ = clamp(own[i]);
      out_.index.push_back(last_);
    }
  }

  // Per face: value f, or the value that entry f of the list names. Some exporters end that list, or each entry, with
  // -1.
  void bind_faces() {
    auto own = from_.index;
    auto& entries = job_.scratch.b;
    entries.clear();
    for (auto i : own)
      if (i != -1) entries.push_back(clamp(i));
    out_.index.resize(mesh_.corners.size());
    std::size_t number = 0, next = 0;
    for (std::size_t f = 0; f < mesh_.n_faces(); ++f, ++number) {
      for (; next < runs_.dropped.size() && runs_.dropped[next] == number; ++next) ++number;
      short_index_ |= !entries.empty() && number >= entries.size();
      std::uint32_t value =
          entries.empty() ? clamp(static_cast<std::int64_t>(number)) : entries[std::min(number, entries.size() - 1)];
      std::fill(out_.index.begin() + mesh_.begin_of(f), out_.index.begin() + mesh_.end_of(f), value);
    }
  }

  float finite(double v) {
    auto f = static_cast<float>(v);
    if (std::isfinite(f)) return f;
    ++n_not_finite_;
    return 0;
  }

  void copy_values() {
    out_.values.resize(count_ * static_cast<std::size_t>(out_.width));
    std::ranges::transform(from_.values.first(out_.values.size()), out_.values.begin(),
                           [this](double v) { return finite(v); });
  }

  void copy_used_values() {
    auto& slot = job_.scratch.map;
    slot.reset(count_);
    std::uint32_t n_used = 0;
    for (auto& i : out_.index) {
      if (!slot.contains(i)) {
        slot.set(i, n_used++);
        auto value = from_.values.subspan(std::size_t{i} * out_.width, out_.width);
        for (double v : value) out_.values.push_back(finite(v));
      }
      i = slot[i];
    }
  }

  void report() {
    if (!short_values_ && !short_index_ && !n_not_finite_) return;
    auto where = job_.scene.where(job_.geometry);
    const std::string what(from_.what);
    auto& diag = job_.ctx.diag;
    if (short_values_) diag.report(Diag::short_attribute, where, title(job_), what + " values", "the geometry");
    if (short_index_) diag.report(Diag::short_attribute, where, title(job_), what + "Index entries", "coordIndex");
    if (n_not_finite_) diag.report(Diag::not_finite, where, title(job_), n_not_finite_);
  }

  MeshJob& job_;
  const Mesh& mesh_;
  Attribute& out_;
  const AttributeBinding& from_;
  const AuthoredRuns& runs_;
  std::size_t count_;
  std::uint32_t last_ = 0;
  std::size_t n_not_finite_ = 0;
  bool short_values_ = false, short_index_ = false;
};

}  // namespace

void bind_attribute(MeshJob& job, Attribute& attribute, const AttributeBinding& binding, const AuthoredRuns& runs) {
  Binder(job, attribute, binding, runs).bind();
}

std::string title(const MeshJob& job) {
  std::string out(job.scene.type(job.geometry).name);
  if (auto name = job.scene.name(job.geometry); !name.empty()) out.append(" ").append(name);
  return out;
}

}  // namespace wrlkit
