// Directions, and axes of stresses, as commands give them.
#pragma once

#include "lang/commands/builder.hpp"

#include <array>
#include <optional>

namespace kaya::lang {

/// A vector of any length but 0.
Parts<Vec3> direction(const ArgumentSpec& spec);

/// Reads two vectors that give the axes of the components of tensors (xx yy zz xy xz yz), and rotates the tensors into global axes: x is
/// along the first vector, y in the plane of both. A tensor given after the vectors would not be rotated, and is refused.
void read_local_axes(Reader& reader, const std::array<std::array<double, 6>*, 4>& tensors, const ArgumentSpec& first,
                     const ArgumentSpec& second);

/// The word `local` of a command with a stress and its gradients.
template <class Command> void add_local_axes(Entry<Command>& entry) {
    const auto first = vector("ax ay az"), second = vector("bx by bz");
    entry.special(
        {"local"}, {first.spec, second.spec},
        [=](Reader& reader, Command& command) {
            if (!command.stress)
                throw Diagnostic("local has no stress to rotate",
                                 "it stands after stress sxx syy szz sxy sxz syz and its gradients")
                    .at(reader.previous().place);
            read_local_axes(reader, {&*command.stress, &command.x_gradient, &command.y_gradient, &command.z_gradient},
                            first.spec, second.spec);
        },
        "axes in which the stress and the gradients before it are given: x along the first vector, y in the plane of both");
}

} // namespace kaya::lang
