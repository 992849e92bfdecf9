// What is around every report: head, style and the choice of light or dark, as in the viewer page. The page stands
// alone and asks for nothing of a network.
#pragma once
#include <string>
#include <string_view>

namespace wrlkit {

/// The page up to where its content begins.
std::string report_begin(std::string_view title);
/// What ends it.
std::string report_end();

/// A table that is wide may be scrolled in a frame of its own, by keyboard too; `name` is read out.
std::string table_begin(std::string_view name);
std::string_view table_end();

/// What sorts, searches and pages the table of `corpus report` (corpus_table.js).
std::string_view corpus_table_script();
/// What searches and sorts the scenes of a gallery (gallery.js).
std::string_view gallery_script();

}  // namespace wrlkit
