// Compiled into each program that finds wrlkit by find_package: tells the library where its picture codecs lie.
#include <wrlkit/base/image/image_codecs.h>

namespace {

[[maybe_unused]] const bool told = wrlkit::set_image_codecs(WRLKIT_IMAGES);

}  // namespace
