// The bare method of a cycle of blocks with zones: a reference for the speed of a program.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace bench {

/// Mohr-Coulomb strength of the zones. Infinite: they are elastic.
struct Strength {
    double cohesion, friction, dilation, tension; ///< angles in degrees
};

/// Blocks of the edge 1, `blocks` in each direction, of `cells` cubes in each direction, of six tetrahedra each. They move at large strain
/// under gravity with local damping; stresses rotate with Jaumann's rate. It omits what kaya must do: there is one material, the law is
/// compiled in, rotation is not exact, there is no energy account, the volume of zones is not checked, multiplications and additions are
/// contracted.
///
/// With joints each gridpoint on a common face of two blocks is a sub-contact with a triangle of the other block, with Coulomb's law, a
/// tensile strength and a cohesion that are lost at the first slip. Sub-contacts never leave their triangles, and planes never rotate.
class ZoneKernel {
public:
    ZoneKernel(int blocks, int cells, const Strength& strength, bool joints = false);

    /// A smooth field of stretch and shear, and zero stress. The largest velocity is about 1.3 times `speed`.
    void start(double speed);
    void step();

    std::size_t zones() const { return zones_; }
    std::size_t sub_contacts() const { return sub_contacts_; }
    std::size_t gridpoints() const { return position_.size(); }
    /// Fraction of the zones that yielded in the last step.
    double yielding() const { return static_cast<double>(yielding_) / static_cast<double>(zones_); }
    /// Sum of the forces of the zones, as a check: zero.
    std::array<double, 3> sum_of_forces() const;
    /// Largest component of such a force.
    double largest_force() const;

private:
    typedef double Eight __attribute__((vector_size(64)));
    typedef double Four __attribute__((vector_size(32)));
    typedef long long Mask __attribute__((vector_size(64)));

    /// Eight zones.
    struct Group {
        int corner[4][8];
        Eight stress[6]; ///< xx, yy, zz, xy, xz, yz
    };
    /// Eight sub-contacts of a block's gridpoints with triangles of a neighbour, or vice versa.
    struct Joint {
        int corner[4][8];   ///< of a gridpoint and of a triangle
        Eight weight[2];    ///< of the first two corners of the triangle
        Eight direction[3]; ///< from the triangle to the gridpoint, unit
        Eight area, normal, shear[3];
        Mask intact;
    };
    struct Material {
        double lame, two_shear, bulk_stiff; ///< the last: K + 4 G / 3
        double density;
        double sine, cosine, slope, flow, cohesion, tension;
    };

    void make_block(int blocks, int cells, int block);
    void move(std::size_t first, std::size_t last);
    void load(Group& group);
    void join(int blocks, int cells, int block);
    void load(Joint& joint);
    void bring_back(Eight (&stress)[6]) const;

    Material material_{};
    double time_step_ = 0;
    std::size_t zones_ = 0, blocks_ = 0, nodes_in_block_ = 0, groups_in_block_ = 0;
    long yielding_ = 0;
    std::vector<Four> position_; ///< and 1 / mass
    std::vector<Four> velocity_, force_;
    std::vector<Group> groups_;
    std::vector<Joint> joints_;
    std::vector<std::size_t>
        joints_of_block_; ///< one more than blocks: start of those with neighbours of higher number
    std::size_t sub_contacts_ = 0;
};

} // namespace bench
