// The page of corpus report: figures and rows as data in it, and a few lines of script that sort, search and leaf.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "base/io/read_file.h"
#include "base/text/json.h"
#include "base/text/xml_text.h"
#include "tools/corpus/report.h"
#include "tools/report/chart.h"
#include "tools/report/report_frame.h"

namespace wrlkit {
namespace {

constexpr std::size_t most_listed = 60, most_failed = 1000;
constexpr double rounding = 1e-9;  // of the diagonal: nobody has moved that far

class Page {
 public:
  explicit Page(const CorpusReport& r) : r_(r) {}

  std::string write() {
    out_ += report_begin("Corpus run: " + r_.out);
    figures();
    changes();
    failures();
    deviations();
    kinds();
    outliers(
        "Most processor time", [](const ReportRow& r) { return r.cpu; },
        [](const ReportRow& r) { return fmt::format("{:.2f} s", r.cpu); });
    outliers(
        "Most memory", [](const ReportRow& r) { return static_cast<double>(r.memory); },
        [](const ReportRow& r) { return readable_size(r.memory); });
    files();
    out_ += report_end();
    return std::move(out_);
  }

 private:
  template <class... T>
  void put(fmt::format_string<T...> format, T&&... values) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<T>(values)...);
  }

  void figures() {
    const auto sum = [&](auto value) {
      return std::accumulate(r_.rows.begin(), r_.rows.end(), 0.0,
                             [&](double s, const ReportRow& r) { return s + static_cast<double>(value(r)); });
    };
    put("<ul class=\"summary\"><li><b>{}</b>files</li>", r_.rows.size());
    for (auto s : {JobState::made, JobState::made_partly, JobState::failed, JobState::crashed, JobState::timeout,
                   JobState::no_memory})
      if (r_.n(s)) put("<li><b{}>{}</b>{}</li>", is_made(s) ? "" : " class=\"bad\"", r_.n(s), to_string(s));
    if (r_.removed) put("<li><b>{}</b>no longer there</li>", r_.removed);
    if (const auto n = r_.n_changed()) put("<li><b>{}</b>changed or gone since</li>", n);
    put("<li><b>{}</b>read</li><li><b>{}</b>written</li><li><b>{:.1f} s</b>of processor time</li></ul>\n",
        readable_size(static_cast<std::uint64_t>(sum([](const ReportRow& r) { return r.input_bytes; }))),
        readable_size(static_cast<std::uint64_t>(sum([](const ReportRow& r) { return r.output_bytes; }))),
        sum([](const ReportRow& r) { return r.cpu; }));
  }

  void changes() {
    if (r_.compared.empty()) return;
    const auto worse = std::ranges::count_if(r_.changes, &Change::worse);
    put("<h2>Compared with {}</h2>\n<p>{} changes, {} of them for the worse.</p>\n{}", xml_text(r_.compared),
        r_.changes.size(), worse, table_begin("Changes"));
    for (std::size_t i = 0; i < std::min(most_failed, r_.changes.size()); ++i)
      put("<tr><td class=\"text\">{}</td><td class=\"text{}\">{}</td></tr>\n", xml_text(r_.changes[i].output),
          r_.changes[i].worse ? " bad" : "", xml_text(r_.changes[i].what));
    out_ += table_end();
  }

  void failures() {
    std::size_t n = 0;
    for (const auto& r : r_.rows) {
      if (is_made(r.state) || n == most_failed) continue;
      if (n++ == 0) put("<h2>Nothing could be made of</h2>\n{}", table_begin("Failures"));
      put("<tr><td class=\"text\">{}</td><td class=\"text bad\">{}</td><td class=\"text\">{}</td></tr>\n",
          xml_text(r.input), to_string(r.state), xml_text(r.cause));
    }
    if (n) out_ += table_end();
  }

  /// Rows by falling value, of those that have one above nothing.
  std::vector<const ReportRow*> largest(auto value) const {
    std::vector<const ReportRow*> rows;
    for (const auto& r : r_.rows)
      if (value(r) > 0) rows.push_back(&r);
    const auto n = std::min(most_listed, rows.size());
    std::ranges::partial_sort(rows, rows.begin() + static_cast<std::ptrdiff_t>(n), std::greater{},
                              [&](const ReportRow* r) { return value(*r); });
    rows.resize(n);
    return rows;
  }

  static double distance(const ReportRow& r) {
    return r.look && r.look->of_diagonal > rounding ? r.look->of_diagonal : 0;
  }

  void deviations() {
    const auto looked = std::ranges::count_if(r_.rows, [](const ReportRow& r) { return r.look.has_value(); });
    if (!looked) return;
    const auto made = std::ranges::count_if(r_.rows, [](const ReportRow& r) { return is_made(r.state); });
    const auto moved = std::ranges::count_if(r_.rows, [](const ReportRow& r) { return distance(r) > 0; });
    const auto shown = largest(distance);
    put("<h2>How far surfaces are from the input</h2>\n<p>{} of {} worlds that were made were measured and drawn, "
        "before and after (--looks), the first by name; {} of them differ{}. The distance is the root of the mean "
        "square, in metres and as a share of the diagonal.</p>\n<div class=\"looks\">\n",
        looked, made, moved, shown.empty() ? "" : fmt::format(", and the {} farthest are shown", shown.size()));
    for (const auto* r : shown)
      put("<figure><div data-look=\"{}\"></div><figcaption>{}<br><span "
          "class=\"soft\">{}</span></figcaption></figure>\n",
          look_index(*r), xml_text(r->input),
          std::isfinite(r->look->rms) ? fmt::format("{:.3g} m rms, {:.3g} m at most; {:.2g} of the diagonal",
                                                    r->look->rms, r->look->max, r->look->of_diagonal)
                                      : "one of the worlds shows no surface, or too large a one");
    put("</div>\n");
  }

  std::ptrdiff_t look_index(const ReportRow& row) const {
    return std::count_if(r_.rows.data(), &row, [](const ReportRow& r) { return r.look.has_value(); });
  }

  void kinds() {
    if (r_.kinds.empty()) return;
    put("<h2>What was lost, repaired or wrong</h2>\n{}<tr><th class=\"text\">message</th><th "
        "class=\"text\">kind</th><th>files</th><th>times</th><th class=\"text\">for example</th></tr>\n",
        table_begin("Messages"));
    std::vector<std::pair<std::string_view, const ReportedKind*>> sorted;
    for (const auto& [name, kind] : r_.kinds) sorted.emplace_back(name, &kind);
    const auto rank = [](const ReportedKind& k) { return k.severity == "error" ? 0 : k.severity == "lost" ? 1 : 2; };
    std::ranges::stable_sort(
        sorted, {}, [&](const auto& k) { return std::tuple(rank(*k.second), -static_cast<double>(k.second->files)); });
    for (const auto& [name, k] : sorted)
      put("<tr><td class=\"text\">{}</td><td class=\"text\">{}</td><td>{}</td><td>{}</td><td "
          "class=\"text\">{}</td></tr>\n",
          name, k->severity, k->files, k->times, xml_text(k->example));
    out_ += table_end();
  }

  void outliers(std::string_view title, auto value, auto text) {
    constexpr std::size_t few = 15;
    auto rows = largest(value);
    rows.resize(std::min(few, rows.size()));
    std::vector<double> all;
    for (const auto& r : r_.rows) all.push_back(value(r));
    if (all.empty()) return;
    std::ranges::nth_element(all, all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2));
    const double median = all[all.size() / 2];
    put("<h2>{}</h2>\n{}", title, table_begin(title));
    for (const auto* r : rows)
      put("<tr><td class=\"text\">{}</td><td>{}</td><td class=\"soft\">{:.0f} times the median</td><td>{}</td></tr>\n",
          xml_text(r->input), text(*r), median > 0 ? value(*r) / median : 0.0, readable_size(r->input_bytes));
    out_ += table_end();
  }

  void files() {
    put("<h2>All files</h2>\n<p class=\"line\"><input id=\"q\" type=\"search\" placeholder=\"Name or cause\" "
        "aria-label=\"Search\"> <select id=\"s\" aria-label=\"State\"><option value=\"\">All states</option></select> "
        "<button type=\"button\" id=\"back\">Back</button> <button type=\"button\" id=\"next\">Next</button> <span "
        "id=\"n\" class=\"soft\" role=\"status\"></span></p>\n{}<thead><tr id=\"head\"></tr></thead><tbody "
        "id=\"rows\"></tbody>{}<script>\nconst states=[",
        table_begin("All files"), table_end());
    for (auto s : {JobState::made, JobState::made_partly, JobState::failed, JobState::crashed, JobState::timeout,
                   JobState::no_memory})
      put("\"{}\",", to_string(s));
    std::string rows, looks;
    JsonOut json(rows), json_looks(looks);
    json.begin_array();
    json_looks.begin_array();
    std::size_t n_looks = 0;
    for (const auto& r : r_.rows) {
      json.begin_array();
      json.values(r.input, static_cast<int>(r.state), r.seconds, r.cpu, r.memory, r.input_bytes, r.output_bytes,
                  r.errors, r.warnings, r.lost);
      if (r.look) {
        json.values(r.look->rms, r.look->max, n_looks++);
        const std::string_view pictures[] = {r.look->before, r.look->after};
        json_looks.value(std::span(pictures));
      } else {
        json.raw("null,null,null");
      }
      json.value(r.cause);
      json.end_array();
    }
    json.end_array();
    json_looks.end_array();
    // "</script>" in a name would end the script, "<!--" and "<script" would keep it open.
    constexpr std::string_view escaped = "\\u003c";
    for (auto* text : {&rows, &looks})
      for (std::size_t at = 0; (at = text->find('<', at)) != text->npos; at += escaped.size())
        text->replace(at, 1, escaped);
    put("];\nconst rows={};\nconst looks={};\n{}</script>\n", rows, looks, corpus_table_script());
  }

  const CorpusReport& r_;
  std::string out_;
};

}  // namespace

std::string report_page(const CorpusReport& r) { return Page(r).write(); }

}  // namespace wrlkit
