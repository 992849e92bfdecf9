// Who is to open a glTF file, and what that means for how it is written. One table: behaviour, --print-profile and the
// page of the documentation come from it.
#pragma once
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "convert/options.h"

namespace wrlkit {

struct Profile {
  std::string_view name, opens_in;
  GltfCompression::Method compress;
  Extras extras;
  GltfTextures::Format texture_format;
  GltfOptions::Names names;
  SkyAs sky;
  std::string_view pipeline;  // what optimize runs in front of what glTF needs
  std::string_view why;
};

/// Its pipeline with forms recognised, and shared whatever their size.
std::string recognising(const Profile&);

std::span<const Profile> profiles();
/// Null: there is none.
const Profile* find_profile(std::string_view name);

/// Takes what a profile chooses; options by these names (SaveOptions::fields) stay as they are.
void apply_profile(SaveOptions&, const Profile&, const std::function<bool(std::string_view name)>& stays = {});

/// For people: the choices of one.
std::string profile_text(const Profile&);
/// All of them, as a page of the documentation.
std::string profiles_page();

}  // namespace wrlkit
