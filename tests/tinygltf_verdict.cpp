#include "tests/tinygltf_verdict.h"

#include <tiny_gltf.h>

namespace wrlkit {
namespace {

bool any_picture(tinygltf::Image* image, int, std::string*, std::string*, int, int, const unsigned char* bytes, int n,
                 void*) {
  image->image.assign(bytes, bytes + n);
  return true;
}

}  // namespace

std::string tinygltf_verdict(const std::string& glb) {
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(any_picture, nullptr);
  tinygltf::Model model;
  std::string error, warning;
  const auto* data = reinterpret_cast<const unsigned char*>(glb.data());
  const bool good = loader.LoadBinaryFromMemory(&model, &error, &warning, data, static_cast<unsigned>(glb.size()));
  return good ? error + warning : "refused: " + error + warning;
}

}  // namespace wrlkit
