#include "convert/convert.h"

#include "convert/load.h"
#include "scenegraph/verify.h"

namespace wrlkit {

bool check_input(Document& document) {
  check_values(document.scene(), document.diag());
  const auto& main = document.scene().main;
  if (!main.roots.empty() || !main.protos.empty() || !document.diag().has_errors()) return true;
  document.diag().report(Diag::nothing_to_write, {});
  return false;
}

Converted convert(const std::string& from, const std::string& to, const ConvertOptions& options, Watch watch) {
  auto load_options = options.load;
  load_options.unpack_pictures |= to != "-";
  Document document = load(from, std::move(load_options), std::move(watch));
  Converted out;
  out.ending = document.ending(false);
  if (document && check_input(document)) static_cast<Saved&>(out) = save(std::move(document), to, options.save);
  // NOLINTNEXTLINE(bugprone-use-after-move): of what is saved the messages stay
  out.messages = document.messages();
  return out;
}

}  // namespace wrlkit
