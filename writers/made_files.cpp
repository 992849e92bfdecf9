#include "writers/made_files.h"

#include <algorithm>
#include <filesystem>

#include "base/io/same_contents.h"
#include "base/io/uri.h"

namespace wrlkit {
namespace fs = std::filesystem;

fs::path stem_of(const std::string& output) {
  fs::path p(output);
  if (p.extension() == ".gz") p.replace_extension();
  return p.replace_extension();
}

MadeFiles::MadeFiles(const Scene& scene, const Resources& resources, std::string output, bool own_folder,
                     Diagnostics& diag)
    : resources_(resources),
      output_(std::move(output)),
      beginning_(stem_of(output_).filename().string() + (own_folder ? "_files/made/" : ".")),
      diag_(diag) {
  if (resources_.made().empty()) return;
  for (std::uint32_t i = 0; i < scene.node_count(); ++i)
    for (const Value& v : scene.fields(NodeId{i}))
      if (const Value& c = scene.content(v); !c.is && c.type == FieldType::MFString)
        for (auto url : c.text_span()) taken_.emplace(url);
}

const std::string& MadeFiles::name_of(const MadeFile& file) {
  auto known = std::ranges::find(placed_, &file, &Placed::file);
  if (known != placed_.end()) return known->name;
  const fs::path own(file.name);
  std::string name = beginning_ + file.name;
  for (int k = 2; taken_.contains(name) || taken_.contains(uri_of(name)); ++k)
    name = beginning_ + own.stem().string() + "_" + std::to_string(k) + own.extension().string();
  taken_.insert(name);
  return placed_.emplace_back(Placed{name, &file, {}}).name;
}

std::string MadeFiles::place(std::string_view url) {
  const MadeFile* file = resources_.find_made(url);
  if (!file) return std::string(url);
  if (output_ != "-") return uri_of(name_of(*file));
  diag_.report(Diag::picture_not_written, {}, file->name);
  return std::string(url);
}

bool MadeFiles::write() {
  for (const MadeFile& file : resources_.made())
    if (file.always && output_ != "-") name_of(file);
  for (Placed& p : placed_) {
    const auto path = (stem_of(output_).parent_path() / p.name).string();
    const std::string_view bytes = *p.file->bytes;
    if (has_contents(path, {&bytes, 1})) resources_.files_written().add(path);  // whoever made it
    p.output = OutputFile::open(
        path, {.inputs = &resources_.files_read(), .written = &resources_.files_written(), .report_replaced = true},
        diag_);
    if (!p.output) return false;
    p.output->write(bytes);
  }
  return true;
}

bool MadeFiles::commit() {
  return std::ranges::all_of(placed_, [&](Placed& p) { return p.output->commit(diag_); });
}

}  // namespace wrlkit
