"""The tables and quantities of a model. Written by scripts/python-stubs from the engine's tables."""

from typing import Any, Literal, overload

import numpy as np
from numpy.typing import NDArray

from .table import Table

class Blocks(Table):
    """All objects of the kind block. Fields, with * where they can be set:

        id: number, from 1 in order of creation
        material: number of its material
        constitutive: number of its constitutive model
        region*: region number
        group*: name of its group, empty when it has none
        body: number of the joined body that it is part of, 0 on its own
        next_joined: next block of the same joined body, null at the end
        type: 1 rigid, 2 deformable
        surface_area: sum of the areas of its faces [area]
        density_scaling: mass in the equation of motion over true mass
        hidden: 1 when hidden
        deformable: 1 when it has zones
        fixed: 1 when all of its motion is prescribed
        volume: volume [volume]
        mass: mass, 0 before the first cycle [mass]
        inertia: moments of inertia about the centroid, global axes [mass*area]
        x_inertia: about the x axis [mass*area]
        y_inertia: about the y axis [mass*area]
        z_inertia: about the z axis [mass*area]
        xy_inertia: product of inertia: the integral of x y dm about the centroid [mass*area]
        xz_inertia: the same of x z [mass*area]
        yz_inertia: the same of y z [mass*area]
        position: centroid [length]
        x: x of the centroid [length]
        y: y of the centroid [length]
        z: z of the centroid [length]
        velocity*: velocity of the centroid [length/time]
        x_velocity*: x velocity [length/time]
        y_velocity*: y velocity [length/time]
        z_velocity*: z velocity [length/time]
        rotational_velocity*: of a rigid block, global axes, radians [radians/time]
        x_rotational_velocity*: about the x axis [radians/time]
        y_rotational_velocity*: about the y axis [radians/time]
        z_rotational_velocity*: about the z axis [radians/time]
        displacement: displacement of the centroid [length]
        x_displacement: x displacement [length]
        y_displacement: y displacement [length]
        z_displacement: z displacement [length]
        force: unbalanced force of the last cycle, with loads and weight [force]
        x_force: x unbalanced force [force]
        y_force: y unbalanced force [force]
        z_force: z unbalanced force [force]
        moment: unbalanced moment of a rigid block [moment]
        x_moment: x unbalanced moment [moment]
        y_moment: y unbalanced moment [moment]
        z_moment: z unbalanced moment [moment]
        load*: applied force [force]
        x_load*: x applied force [force]
        y_load*: y applied force [force]
        z_load*: z applied force [force]
        first_gridpoint: first of its gridpoints
        first_vertex: first of its vertices
        first_face: first of its faces
        first_zone: first of its zones, null in a rigid block
    """
    @overload
    def __getitem__(self, field: Literal[
        "id",
        "material",
        "constitutive",
        "region",
        "body",
        "next_joined",
        "type",
        "hidden",
        "deformable",
        "fixed",
        "first_gridpoint",
        "first_vertex",
        "first_face",
        "first_zone"]) -> NDArray[np.int64]: ...
    @overload
    def __getitem__(self, field: Literal[
        "group"]) -> list[str]: ...
    @overload
    def __getitem__(self, field: Literal[
        "surface_area",
        "density_scaling",
        "volume",
        "mass",
        "inertia",
        "x_inertia",
        "y_inertia",
        "z_inertia",
        "xy_inertia",
        "xz_inertia",
        "yz_inertia",
        "position",
        "x",
        "y",
        "z",
        "velocity",
        "x_velocity",
        "y_velocity",
        "z_velocity",
        "rotational_velocity",
        "x_rotational_velocity",
        "y_rotational_velocity",
        "z_rotational_velocity",
        "displacement",
        "x_displacement",
        "y_displacement",
        "z_displacement",
        "force",
        "x_force",
        "y_force",
        "z_force",
        "moment",
        "x_moment",
        "y_moment",
        "z_moment",
        "load",
        "x_load",
        "y_load",
        "z_load"]) -> NDArray[np.float64]: ...
    @overload
    def __getitem__(self, field: str) -> Any: ...

class Gridpoints(Table):
    """All objects of the kind gridpoint. Fields, with * where they can be set:

        id: number, from 1; changes when blocks are deleted
        block: block that it belongs to
        position: where it is now [length]
        x: x [length]
        y: y [length]
        z: z [length]
        mass: mass, 0 before the first cycle [mass]
        density_scaling: mass in the equation of motion over true mass
        group: group of its block
        fixed: sum of 1, 2, 4 for x, y, z velocities that are prescribed
        velocity*: velocity [length/time]
        x_velocity*: x velocity [length/time]
        y_velocity*: y velocity [length/time]
        z_velocity*: z velocity [length/time]
        displacement*: displacement [length]
        x_displacement*: x displacement [length]
        y_displacement*: y displacement [length]
        z_displacement*: z displacement [length]
        force: unbalanced force of the last cycle, with loads and weight [force]
        x_force: x unbalanced force [force]
        y_force: y unbalanced force [force]
        z_force: z unbalanced force [force]
        reaction: force that holds what is prescribed of its velocity, of deformable blocks [force]
        x_reaction: x reaction [force]
        y_reaction: y reaction [force]
        z_reaction: z reaction [force]
        pore_pressure*: pore pressure given by initialize pp or insitu pp [stress]
        load*: applied force [force]
        x_load*: x applied force [force]
        y_load*: y applied force [force]
        z_load*: z applied force [force]
    """
    @overload
    def __getitem__(self, field: Literal[
        "id",
        "block",
        "fixed"]) -> NDArray[np.int64]: ...
    @overload
    def __getitem__(self, field: Literal[
        "position",
        "x",
        "y",
        "z",
        "mass",
        "density_scaling",
        "velocity",
        "x_velocity",
        "y_velocity",
        "z_velocity",
        "displacement",
        "x_displacement",
        "y_displacement",
        "z_displacement",
        "force",
        "x_force",
        "y_force",
        "z_force",
        "reaction",
        "x_reaction",
        "y_reaction",
        "z_reaction",
        "pore_pressure",
        "load",
        "x_load",
        "y_load",
        "z_load"]) -> NDArray[np.float64]: ...
    @overload
    def __getitem__(self, field: Literal[
        "group"]) -> list[str]: ...
    @overload
    def __getitem__(self, field: str) -> Any: ...

class Zones(Table):
    """All objects of the kind zone. Fields, with * where they can be set:

        id: number, from 1; changes when blocks are deleted
        block: block that it belongs to
        position: centroid [length]
        x: x of the centroid [length]
        y: y of the centroid [length]
        z: z of the centroid [length]
        volume: volume as it is now [volume]
        mass: density times the volume when made, NaN without a density [mass]
        group*: group that it is in itself, else that of its block
        model: name of its zone model
        state: bits of its state, which its zone model names; elastic zones have none
        plastic_shear_strain: first history variable of its zone model: plastic shear strain of those that ship
        plastic_tensile_strain: second history variable of its zone model: plastic strain by the tension cut-off of those that ship
        material: number of its material
        bulk: bulk modulus, NaN when not given [stress]
        shear: shear modulus, NaN when not given [stress]
        xx_stress*: xx stress [stress]
        yy_stress*: yy stress [stress]
        zz_stress*: zz stress [stress]
        xy_stress*: xy stress [stress]
        xz_stress*: xz stress [stress]
        yz_stress*: yz stress [stress]
        pore_pressure: mean water pressure at its gridpoints [stress]
        volumetric_strain: volumetric strain by the displacements of its gridpoints
        volumetric_strain_rate: the same by their velocities [1/time]
        shear_strain: half the difference of largest and smallest principal strain, by the displacements of its gridpoints
        shear_strain_rate: the same by their velocities [1/time]
        principal_stress_1: most compressive principal stress [stress]
        principal_stress_2: middle principal stress [stress]
        principal_stress_3: least compressive principal stress [stress]
    """
    @overload
    def __getitem__(self, field: Literal[
        "id",
        "block",
        "state",
        "material"]) -> NDArray[np.int64]: ...
    @overload
    def __getitem__(self, field: Literal[
        "position",
        "x",
        "y",
        "z",
        "volume",
        "mass",
        "plastic_shear_strain",
        "plastic_tensile_strain",
        "bulk",
        "shear",
        "xx_stress",
        "yy_stress",
        "zz_stress",
        "xy_stress",
        "xz_stress",
        "yz_stress",
        "pore_pressure",
        "volumetric_strain",
        "volumetric_strain_rate",
        "shear_strain",
        "shear_strain_rate",
        "principal_stress_1",
        "principal_stress_2",
        "principal_stress_3"]) -> NDArray[np.float64]: ...
    @overload
    def __getitem__(self, field: Literal[
        "group",
        "model"]) -> list[str]: ...
    @overload
    def __getitem__(self, field: str) -> Any: ...

class Faces(Table):
    """All objects of the kind face. Fields, with * where they can be set:

        id: number, from 1; changes when blocks are deleted
        block: block that it bounds
        joint_set: joint set that cut it, 0 when made with the block
        group*: group that it is in itself, else that of its block
        position: centroid [length]
        x: x of the centroid [length]
        y: y of the centroid [length]
        z: z of the centroid [length]
        normal: outward unit normal
        x_normal: x of the normal
        y_normal: y of the normal
        z_normal: z of the normal
        vertex_count: number of gridpoints on it
        area: area [area]
    """
    @overload
    def __getitem__(self, field: Literal[
        "id",
        "block",
        "joint_set",
        "vertex_count"]) -> NDArray[np.int64]: ...
    @overload
    def __getitem__(self, field: Literal[
        "group"]) -> list[str]: ...
    @overload
    def __getitem__(self, field: Literal[
        "position",
        "x",
        "y",
        "z",
        "normal",
        "x_normal",
        "y_normal",
        "z_normal",
        "area"]) -> NDArray[np.float64]: ...
    @overload
    def __getitem__(self, field: str) -> Any: ...

class Contacts(Table):
    """All objects of the kind contact. Fields, with * where they can be set:

        id: number, from 1
        type: 1 face-face, 2 face-edge, 3 face-vertex, 4 edge-edge, 5 edge-vertex, 6 vertex-vertex
        block1: block with the higher number
        block2: block with the lower number
        first_sub_contact: first of its sub-contacts
        position: a point of the common plane [length]
        x: x [length]
        y: y [length]
        z: z [length]
        normal: unit normal from block1 to block2
        x_normal: x of the normal
        y_normal: y of the normal
        z_normal: z of the normal
        area: area of the overlap [area]
        material: number of its joint material
        constitutive: number of its joint model, 0 when that has none
        joint_set: joint set that made it, 0 for none
        group*: group of the contact, empty when it has none
        model: name of its joint model, empty when it has none
        normal_displacement: mean, opening positive [length]
        normal_force: sum, compression positive [force]
        shear_force: sum of the shear force vectors [force]
    """
    @overload
    def __getitem__(self, field: Literal[
        "id",
        "type",
        "block1",
        "block2",
        "first_sub_contact",
        "material",
        "constitutive",
        "joint_set"]) -> NDArray[np.int64]: ...
    @overload
    def __getitem__(self, field: Literal[
        "position",
        "x",
        "y",
        "z",
        "normal",
        "x_normal",
        "y_normal",
        "z_normal",
        "area",
        "normal_displacement",
        "normal_force",
        "shear_force"]) -> NDArray[np.float64]: ...
    @overload
    def __getitem__(self, field: Literal[
        "group",
        "model"]) -> list[str]: ...
    @overload
    def __getitem__(self, field: str) -> Any: ...

class SubContacts(Table):
    """All objects of the kind sub_contact. Fields, with * where they can be set:

        id: number, from 1
        contact: contact that it belongs to
        block1: block with the higher number
        block2: block with the lower number
        type: 1 vertex-face, 2 face-vertex, 3 edge-edge
        position: where it is now [length]
        x: x [length]
        y: y [length]
        z: z [length]
        normal: unit normal of the contact, from block1 to block2
        x_normal: x of the normal
        y_normal: y of the normal
        z_normal: z of the normal
        area: part of the contact's area [area]
        material: number of its joint material
        constitutive: number of its joint model, 0 when that has none
        vertex: vertex that meets a face, null between two edges
        face: face that a vertex meets, null when there is none
        pressure_force: pore pressure times area [force]
        group*: group that it is in itself, else that of its contact; empty: none
        model: name of its joint model, empty when it has none
        normal_displacement*: opening positive [length]
        shear_displacement: length of the shear displacement vector [length]
        shear_displacement_vector*: in global axes [length]
        x_shear_displacement*: global x component [length]
        y_shear_displacement*: global y component [length]
        z_shear_displacement*: global z component [length]
        normal_force*: compression positive [force]
        shear_force: length of the shear force vector [force]
        shear_force_vector*: on block2, in global axes [force]
        x_shear_force*: global x component [force]
        y_shear_force*: global y component [force]
        z_shear_force*: global z component [force]
        normal_stress: normal force over area, compression positive [stress]
        shear_stress: length of the shear force over area [stress]
        normal_stiffness: tangent stiffness [stress/length]
        shear_stiffness: tangent stiffness [stress/length]
        pore_pressure*: in the joint, compression positive [stress]
        frictional_work: done by slip [energy]
        state*: sum of 1, 2, 4, ... for the model's state names
    """
    @overload
    def __getitem__(self, field: Literal[
        "id",
        "contact",
        "block1",
        "block2",
        "type",
        "material",
        "constitutive",
        "vertex",
        "face",
        "state"]) -> NDArray[np.int64]: ...
    @overload
    def __getitem__(self, field: Literal[
        "position",
        "x",
        "y",
        "z",
        "normal",
        "x_normal",
        "y_normal",
        "z_normal",
        "area",
        "pressure_force",
        "normal_displacement",
        "shear_displacement",
        "shear_displacement_vector",
        "x_shear_displacement",
        "y_shear_displacement",
        "z_shear_displacement",
        "normal_force",
        "shear_force",
        "shear_force_vector",
        "x_shear_force",
        "y_shear_force",
        "z_shear_force",
        "normal_stress",
        "shear_stress",
        "normal_stiffness",
        "shear_stiffness",
        "pore_pressure",
        "frictional_work"]) -> NDArray[np.float64]: ...
    @overload
    def __getitem__(self, field: Literal[
        "group",
        "model"]) -> list[str]: ...
    @overload
    def __getitem__(self, field: str) -> Any: ...

class Corners(Table):
    """All objects of the kind corner. Fields, with * where they can be set:

        face: face that it is on
        gridpoint: gridpoint that is there
        vertex: the same: a vertex of a rigid block is a gridpoint
    """
    @overload
    def __getitem__(self, field: Literal[
        "face",
        "gridpoint",
        "vertex"]) -> NDArray[np.int64]: ...
    @overload
    def __getitem__(self, field: str) -> Any: ...

class CableNodes(Table):
    """All objects of the kind cable_node. Fields, with * where they can be set:

        id: number, from 1; changes when cables are deleted
        cable: number of its cable
        property: number of its properties
        block: block in which it lies
        position: place in the rock [length]
        x: x of it [length]
        y: y of it [length]
        z: z of it [length]
        cable_force: tension of the cable: the mean of the bars on both sides [force]
        slip: of the cable past the rock, towards its last end [length]
        grout_force: of the rock on the cable, along it, per length [force/length]
        grout_state: 1: slips; 2: has slipped
        anchored: 1 where the cable cannot slip
        force: on the rock [force]
        x_force: x of it [force]
        y_force: y of it [force]
        z_force: z of it [force]
        bar_force: tension of the bar to the next node; 0 at the last one [force]
        bar_stress: the same over the area of the cable [stress]
        plastic_strain: of that bar
        bar_state: 1: yields; 2: has yielded; 4: is broken
    """
    @overload
    def __getitem__(self, field: Literal[
        "id",
        "cable",
        "property",
        "block",
        "grout_state",
        "anchored",
        "bar_state"]) -> NDArray[np.int64]: ...
    @overload
    def __getitem__(self, field: Literal[
        "position",
        "x",
        "y",
        "z",
        "cable_force",
        "slip",
        "grout_force",
        "force",
        "x_force",
        "y_force",
        "z_force",
        "bar_force",
        "bar_stress",
        "plastic_strain"]) -> NDArray[np.float64]: ...
    @overload
    def __getitem__(self, field: str) -> Any: ...

class StructureNodes(Table):
    """All objects of the kind structure_node. Fields, with * where they can be set:

        id: number, from 1; changes when beams or liners are deleted
        structure: number of its beam or liner
        property: number of its properties
        block: block that it lies on
        position: place [length]
        x: x of it [length]
        y: y of it [length]
        z: z of it [length]
        displacement: displacement [length]
        x_displacement: x of it [length]
        y_displacement: y of it [length]
        z_displacement: z of it [length]
        velocity*: velocity [length/time]
        rotation: from how it was made: axis times angle in radians, global axes
        spin*: rotational velocity [1/time]
        force: on the rock [force]
        x_force: x of it [force]
        y_force: y of it [force]
        z_force: z of it [force]
        moment: on the rock; of a clamped node [moment]
        link_tension: of the link along the normal of the face, per area of a liner and length of a beam
        link_shear: of the link along the face, per area of a liner and length of a beam
        link_state: 1: slips; 2: has slipped; 4: the bond is broken
        hold: 0: lies on no rock; 1: springs; 2: goes with the rock; 3: turns with it too
        mass: its own [mass]
        inertial_mass: in the equation of motion [mass]
    """
    @overload
    def __getitem__(self, field: Literal[
        "id",
        "structure",
        "property",
        "block",
        "link_state",
        "hold"]) -> NDArray[np.int64]: ...
    @overload
    def __getitem__(self, field: Literal[
        "position",
        "x",
        "y",
        "z",
        "displacement",
        "x_displacement",
        "y_displacement",
        "z_displacement",
        "velocity",
        "rotation",
        "spin",
        "force",
        "x_force",
        "y_force",
        "z_force",
        "moment",
        "link_tension",
        "link_shear",
        "mass",
        "inertial_mass"]) -> NDArray[np.float64]: ...
    @overload
    def __getitem__(self, field: str) -> Any: ...

class BeamElements(Table):
    """All objects of the kind beam_element. Fields, with * where they can be set:

        id: number, from 1; changes when beams or liners are deleted
        structure: number of its beam
        property: number of its properties
        position: middle [length]
        x: x of it [length]
        y: y of it [length]
        z: z of it [length]
        length: length [length]
        axial_force: tension positive [force]
        shear_y: shear force along its axis y [force]
        shear_z: shear force along its axis z [force]
        torsion: about its axis [moment]
        moment_y_first: about y at its first node [moment]
        moment_y_last: about y at its last node [moment]
        moment_z_first: about z at its first node [moment]
        moment_z_last: about z at its last node [moment]
        moment: the largest bending moment of both ends, about any axis [moment]
        plastic_strain: along its axis
        hinge_rotation: the largest of its plastic hinges, in radians
        state: 1: yields; 2: has yielded
    """
    @overload
    def __getitem__(self, field: Literal[
        "id",
        "structure",
        "property",
        "state"]) -> NDArray[np.int64]: ...
    @overload
    def __getitem__(self, field: Literal[
        "position",
        "x",
        "y",
        "z",
        "length",
        "axial_force",
        "shear_y",
        "shear_z",
        "torsion",
        "moment_y_first",
        "moment_y_last",
        "moment_z_first",
        "moment_z_last",
        "moment",
        "plastic_strain",
        "hinge_rotation"]) -> NDArray[np.float64]: ...
    @overload
    def __getitem__(self, field: str) -> Any: ...

class LinerElements(Table):
    """All objects of the kind liner_element. Fields, with * where they can be set:

        id: number, from 1; changes when beams or liners are deleted
        structure: number of its liner
        property: number of its properties
        position: centroid [length]
        x: x of it [length]
        y: y of it [length]
        z: z of it [length]
        area: area [area]
        axis: its axis x
        normal: out of the rock
        membrane_xx: along its axis x; tension positive [force/length]
        membrane_yy: along its axis y [force/length]
        membrane_xy: shear [force/length]
        membrane_1: the greater principal one [force/length]
        membrane_2: the smaller principal one: the largest thrust, negative [force/length]
        moment_xx: that bends fibres along its axis x; positive with tension on the side out of the rock [moment/length]
        moment_yy: the same along its axis y [moment/length]
        moment_xy: twisting moment [moment/length]
        moment_1: the greater principal one [moment/length]
        moment_2: the smaller principal one [moment/length]
        greatest_stress: greatest principal stress at both surfaces; tension positive [stress]
        least_stress: least principal stress at both surfaces [stress]
    """
    @overload
    def __getitem__(self, field: Literal[
        "id",
        "structure",
        "property"]) -> NDArray[np.int64]: ...
    @overload
    def __getitem__(self, field: Literal[
        "position",
        "x",
        "y",
        "z",
        "area",
        "axis",
        "normal",
        "membrane_xx",
        "membrane_yy",
        "membrane_xy",
        "membrane_1",
        "membrane_2",
        "moment_xx",
        "moment_yy",
        "moment_xy",
        "moment_1",
        "moment_2",
        "greatest_stress",
        "least_stress"]) -> NDArray[np.float64]: ...
    @overload
    def __getitem__(self, field: str) -> Any: ...

class Quantities:
    """What a model has: a table of each kind of object, and quantities of the whole."""
    @property
    def time(self) -> float:
        """model time [time]"""
    @property
    def step(self) -> int:
        """the same as cycle"""
    @property
    def time_step(self) -> float:
        """time step, 0 until it is computed [time]"""
    @property
    def unbalanced_force(self) -> float:
        """largest unbalanced force of the last cycle [force]"""
    @property
    def average_ratio(self) -> float:
        """mean unbalanced force over mean acting force"""
    @property
    def maximum_ratio(self) -> float:
        """largest unbalanced force over mean acting force"""
    @property
    def local_ratio(self) -> float:
        """largest ratio of unbalanced to acting force of one body"""
    @property
    def factor_of_safety(self) -> float:
        """found last by solve fos, limit equilibrium or list stability (then the least of the blocks); 0 when there was none"""
    @property
    def peak_load(self) -> float:
        """greatest load of the last solve control, of its rows at rest; a force where a boundary was driven; 0 when there was none"""
    @property
    def peak_displacement(self) -> float:
        """displacement of the last solve control at its peak load; 0 when there was none"""
    @property
    def global_viscosity(self) -> float:
        """viscosity of adaptive global damping [1/time]"""
    @property
    def kinetic_energy(self) -> float:
        """of all blocks, half a step ago [energy]"""
    @property
    def gravity_work(self) -> float:
        """done by gravity on the blocks [energy]"""
    @property
    def boundary_work(self) -> float:
        """done by loads and prescribed velocities on the blocks [energy]"""
    @property
    def damped_energy(self) -> float:
        """taken out by damping [energy]"""
    @property
    def joint_work(self) -> float:
        """work on joints: stored or lost [energy]"""
    @property
    def frictional_energy(self) -> float:
        """lost in slip and failure [energy]"""
    @property
    def touch_energy(self) -> float:
        """lost in contact updates [energy]"""
    @property
    def zone_work(self) -> float:
        """work on zones [energy]"""
    @property
    def structure_work(self) -> float:
        """work on cables, beams and liners: stored or lost [energy]"""
    @property
    def step_energy(self) -> float:
        """time-step changes [energy]"""
    @property
    def energy_error(self) -> float:
        """residual of the energy balance [energy]"""
    @property
    def gravity(self) -> NDArray[np.float64]:
        """gravity [acceleration]"""
    @property
    def x_gravity(self) -> float:
        """x component of gravity [acceleration]"""
    @property
    def y_gravity(self) -> float:
        """y component of gravity [acceleration]"""
    @property
    def z_gravity(self) -> float:
        """z component of gravity [acceleration]"""
    @property
    def gravity_x(self) -> float:
        """the same as x_gravity [acceleration]"""
    @property
    def gravity_y(self) -> float:
        """the same as y_gravity [acceleration]"""
    @property
    def gravity_z(self) -> float:
        """the same as z_gravity [acceleration]"""
    @property
    def time_step_fraction(self) -> float:
        """time step as a fraction of the largest stable one"""
    @property
    def zone_time_step_fraction(self) -> float:
        """the same as time_step_fraction"""
    @property
    def globally_damped(self) -> int:
        """1 with adaptive global damping"""
    @property
    def locally_damped(self) -> int:
        """1 with local damping"""
    @property
    def rayleigh_alpha(self) -> float:
        """Rayleigh damping of the mass, 0 when that part does not act [1/time]"""
    @property
    def rayleigh_beta(self) -> float:
        """Rayleigh damping of the stiffness, 0 when that part does not act [time]"""
    @property
    def block_count(self) -> int:
        """number of blocks"""
    @property
    def gridpoint_count(self) -> int:
        """number of gridpoints and vertices"""
    @property
    def zone_count(self) -> int:
        """number of zones"""
    @property
    def contact_count(self) -> int:
        """number of contacts"""
    @property
    def sub_contact_count(self) -> int:
        """number of sub-contacts"""
    @property
    def first_block(self) -> int | None:
        """first block of the list that b_next walks"""
    @property
    def last_block(self) -> int | None:
        """block that was made last, the last part of a concave one"""
    @property
    def first_contact(self) -> int | None:
        """first contact of the list that c_next walks"""
    @property
    def blocks(self) -> Blocks:
        """Objects of the kind block."""
    @property
    def gridpoints(self) -> Gridpoints:
        """Objects of the kind gridpoint."""
    @property
    def zones(self) -> Zones:
        """Objects of the kind zone."""
    @property
    def faces(self) -> Faces:
        """Objects of the kind face."""
    @property
    def contacts(self) -> Contacts:
        """Objects of the kind contact."""
    @property
    def sub_contacts(self) -> SubContacts:
        """Objects of the kind sub_contact."""
    @property
    def corners(self) -> Corners:
        """Objects of the kind corner."""
    @property
    def cable_nodes(self) -> CableNodes:
        """Objects of the kind cable_node."""
    @property
    def structure_nodes(self) -> StructureNodes:
        """Objects of the kind structure_node."""
    @property
    def beam_elements(self) -> BeamElements:
        """Objects of the kind beam_element."""
    @property
    def liner_elements(self) -> LinerElements:
        """Objects of the kind liner_element."""
