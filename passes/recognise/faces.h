// What the pass `recognise` asks of meshes and forms.
#pragma once
#include <cstdint>
#include <optional>
#include <span>

#include "geometry/forms/form.h"

namespace wrlkit {

/// Of those faces; of all when there are none and `listed` is off.
std::size_t triangles_in(const Mesh& mesh, std::span<const std::uint32_t> faces, bool listed = false);

/// A mesh of some of the faces, with their attributes.
Mesh only_faces(const Mesh& mesh, std::span<const std::uint32_t> faces);

/// Whether normals that the file gives, if it does, point to the side of the form that each face is on: within the
/// angle that its chords span.
bool has_normals_of(const Mesh& mesh, std::span<const std::uint32_t> faces, const Form& form);

/// The colour of all these faces; a fourth number of -1: without alpha. Nothing when they have several, or none.
std::optional<Vec4> color_of(const Mesh& mesh, std::span<const std::uint32_t> faces);

/// How far points of a form are from its origin, at most.
double reach_of_form(const Form& form);

/// Lengths to whole steps, so that equal parts become equal forms. Moves no point by more than the step.
void round_sizes(Form& form, double step);

}  // namespace wrlkit
