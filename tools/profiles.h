// Who is to open a glTF file, and what that means for how it is written. One table: behaviour, --print-profile and the
// page of the documentation come from it.
#pragma once
#include <span>
#include <string>
#include <string_view>

namespace wrlkit {

struct Profile {
  std::string_view name, opens_in;
  std::string_view compress;        // as --compress says
  std::string_view extras;          // as --extras says
  std::string_view texture_format;  // as --texture-format says
  std::string_view names;           // as --names says
  std::string_view pipeline;        // what optimize runs in front of what glTF needs
  std::string_view why;
};

std::span<const Profile> profiles();
/// Null: there is none.
const Profile* find_profile(std::string_view name);

/// For people: the choices of one.
std::string profile_text(const Profile&);
/// All of them, as a page of the documentation.
std::string profiles_page();

}  // namespace wrlkit
