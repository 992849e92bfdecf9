// Takes the noise out of the light of a page: an edge-avoiding a-trous wavelet filter (Dammertz et al. 2010), led
// by where texels lie and by the noise that was measured in them (Schied et al. 2017).
#pragma once
#include "passes/lightmap/page.h"

namespace wrlkit::bake {

struct DenoiseOptions {
  int passes = 3;        // the widest reaches 2 ^ passes texels to each side
  float contrast = 1.5;  // standard deviations of luminance that count as noise
};

/// Changes the layers of the covered texels, and leaves in `variance` what the wavelets left. Light is mixed within a
/// chart, between texels that face the same way and lie in one plane, and as far as it differs by no more than its
/// noise explains: what is exact stays as it is. Where more was taken out than the noise that was measured, the share
/// that is more comes back: detail of one texel, such as edges of thin shadows. O(texels * passes), the same for any
/// number of threads.
void denoise(const Page& page, Estimate& estimate, const DenoiseOptions& options = {});

/// Both estimates together, each filtered by its own noise unless `denoised` is false.
std::vector<Rgb> shown_light(const Page& page, Estimate direct, Estimate gathered, bool denoised);

}  // namespace wrlkit::bake
