"""Kinds and blocks of model files, one class each.

Made by `tools/blocks.py` of the cards and the schema of the library; do not edit. What a class is given is written into the
text of a model, and the reader of model files checks it: quantities are numbers in SI (or in the `units` of the model) or
texts with units or expressions (``"30 kN/m"``, ``"mu * mass * g"``); names in a `Word` field may be texts.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, TypeAlias

from ._ron import Block, Word

#: A number in SI, or a text with a unit or an expression.
Quantity: TypeAlias = "float | str"
#: A bare name.
Name: TypeAlias = "Word | str | type[Block]"


#: Fields of blocks without a name that take a bare name.
WORDS = frozenset({"direction", "dof", "plane"})

AT2 = Word("AT2")
All = Word("All")
Always = Word("Always")
Approach = Word("Approach")
Axes = Word("Axes")
Bending = Word("Bending")
Both = Word("Both")
COSMOS = Word("COSMOS")
CSMIP = Word("CSMIP")
Columns = Word("Columns")
Compression = Word("Compression")
Consistent = Word("Consistent")
Contact = Word("Contact")
Coulomb = Word("Coulomb")
Cubic = Word("Cubic")
Direction = Word("Direction")
ESM = Word("ESM")
Error = Word("Error")
FixedPoint = Word("FixedPoint")
Fna = Word("Fna")
FullNewton = Word("FullNewton")
Hertzdamp = Word("Hertzdamp")
Hht = Word("Hht")
Hold = Word("Hold")
Hyperbolic = Word("Hyperbolic")
InContact = Word("InContact")
Isotropic = Word("Isotropic")
Iwan = Word("Iwan")
Jankowski = Word("Jankowski")
KNET = Word("KNET")
Keep = Word("Keep")
Kinematic = Word("Kinematic")
Lumped = Word("Lumped")
M2 = Word("M2")
M3 = Word("M3")
N = Word("N")
Negative = Word("Negative")
Newton = Word("Newton")
PeakOriented = Word("PeakOriented")
Pinching = Word("Pinching")
Pivot = Word("Pivot")
Positive = Word("Positive")
R1 = Word("R1")
R2 = Word("R2")
R3 = Word("R3")
RitzHht = Word("RitzHht")
Rx = Word("Rx")
Ry = Word("Ry")
Rz = Word("Rz")
Sand = Word("Sand")
Shallow = Word("Shallow")
Spherical = Word("Spherical")
Strip = Word("Strip")
T = Word("T")
Takeda = Word("Takeda")
Tension = Word("Tension")
U1 = Word("U1")
U2 = Word("U2")
U3 = Word("U3")
Ux = Word("Ux")
Uy = Word("Uy")
Uz = Word("Uz")
V2 = Word("V2")
V3 = Word("V3")
VelocityForce = Word("VelocityForce")
VelocityPressure = Word("VelocityPressure")
X = Word("X")
XY = Word("XY")
XZ = Word("XZ")
Y = Word("Y")
YZ = Word("YZ")
Z = Word("Z")
Zero = Word("Zero")


class AbsoluteAdd(Block):
    """Largest magnitudes added, to both sides.

    :param cases: Cases, and combinations that stand before, with their factors; names in a list have the factor
        1.
    """

    _name = "AbsoluteAdd"

    def __init__(
        self,
        *,
        cases: Any | None = None,
    ) -> None:
        super().__init__(
            cases=cases,
        )


class Acceleration(Block):
    """Acceleration, relative to the base or absolute.

    :param node: The node. Default: `terms`.
    :param dof: Direction. One of Ux, Uy, Uz, Rx, Ry, Rz. Default: `terms`.
    :param factor: Factor, with or without unit. Default: `1`.
    :param terms: Several terms that are added, such as a drift; in place of `node` and `dof`. Default: a single
        term.
    :param absolute: With the acceleration of the base. Default: `false`.
    :param hidden: Other outputs are made from it, and it is left out of files, report and summary. Default:
        `false`.
    """

    _name = "Acceleration"
    _words = frozenset({"dof"})

    def __init__(
        self,
        *,
        node: str | None = None,
        dof: Name | None = None,
        factor: Quantity | None = None,
        terms: Sequence[Any] | None = None,
        absolute: bool | str | None = None,
        hidden: bool | str | None = None,
    ) -> None:
        super().__init__(
            node=node,
            dof=dof,
            factor=factor,
            terms=terms,
            absolute=absolute,
            hidden=hidden,
        )


class Adaptive(Block):
    """Substeps by error control: each is taken whole and in two halves.

    :param tolerance: Error of a step at most: in energy (as a square root), displacement and link force, each
        relative to the largest so far. Default: `1e-4`.
    """

    _name = "Adaptive"

    def __init__(
        self,
        *,
        tolerance: Quantity | None = None,
    ) -> None:
        super().__init__(
            tolerance=tolerance,
        )


class Aluminium(Block):
    """Aluminium alloys (EN 1999-1-1, 3.2.5).

    :param young: Young's modulus. Default: `"70 GPa"`.
    :param poisson: Poisson's ratio. Default: `0.3`.
    :param density: Density. Default: `"2700 kg/m^3"`.
    :param expansion: Strain by one kelvin. Default: `2.3e-5`.
    """

    _name = "Aluminium"

    def __init__(
        self,
        *,
        young: Quantity | None = None,
        poisson: Quantity | None = None,
        density: Quantity | None = None,
        expansion: Quantity | None = None,
    ) -> None:
        super().__init__(
            young=young,
            poisson=poisson,
            density=density,
            expansion=expansion,
        )


class BandLimited(Block):
    """Band-limited: frequencies that the new step cannot hold are taken out.

    :param dt: The new step.
    """

    _name = "BandLimited"

    def __init__(
        self,
        *,
        dt: Quantity | None = None,
    ) -> None:
        super().__init__(
            dt=dt,
        )


class BaseShear(Block):
    """Horizontal force that the structure passes to its supports and to the ground.

    :param direction: Direction. One of X, Y.
    :param hidden: Other outputs are made from it, and it is left out of files, report and summary. Default:
        `false`.
    """

    _name = "BaseShear"
    _words = frozenset({"direction"})

    def __init__(
        self,
        *,
        direction: Name | None = None,
        hidden: bool | str | None = None,
    ) -> None:
        super().__init__(
            direction=direction,
            hidden=hidden,
        )


class Beam(Block):
    """Two-node beam in space, Euler–Bernoulli or Timoshenko, with releases and rigid offsets. On 2 nodes.

    :param nodes: The nodes. Default: `node`.
    :param node: The only node: a link or spring between it and the ground. Default: `nodes`.
    :param use: Parameters from the set; those given beside it come first. Default: none.
    :param young: Young's modulus (N/m², > 0).
    :param shear_modulus: shear modulus; or give `poisson` (N/m², > 0, default absent).
    :param poisson: Poisson's ratio, G = E/(2(1 + ν)) (–, between -0.99 and 0.5, default absent).
    :param area: area of the section; or give `width` and `depth` (m², > 0, default absent).
    :param i2: second moment about local 2; none: no stiffness there (m⁴, > 0, default absent).
    :param i3: second moment about local 3; none: no stiffness there (m⁴, > 0, default absent).
    :param torsion: torsion constant; none: no stiffness there (m⁴, > 0, default absent).
    :param width: side of a rectangular section along local 3 (m, > 0, default absent).
    :param depth: side of a rectangular section along local 2 (m, > 0, default absent).
    :param shear_area_2: effective area for shear along local 2 (m², > 0, default absent).
    :param shear_area_3: effective area for shear along local 3 (m², > 0, default absent).
    :param shear_coefficient: instead of shear areas: A₂ = A₃ = κ A (–, > 0, default absent).
    :param density: density, for the mass (kg/m³, ≥ 0, default 0).
    :param distributed_mass: further mass per length (kg/m, ≥ 0, default 0).
    :param expansion: strain by one kelvin, for loads of warmth (–, > 0, default absent).
    :param mass_matrix: how the mass is spread (Lumped, Consistent, default Lumped). One of Lumped, Consistent.
    :param release_i: local directions released at end i (some of U1, U2, U3, R1, R2, R3, default absent). One of
        U1, U2, U3, R1, R2, R3.
    :param release_j: local directions released at end j (some of U1, U2, U3, R1, R2, R3, default absent). One of
        U1, U2, U3, R1, R2, R3.
    :param offset_i: rigid length along the axis at i (m, ≥ 0, default 0).
    :param offset_j: rigid length along the axis at j (m, ≥ 0, default 0).
    :param offsets_stiffen: what rigid lengths stiffen: `Bending` leaves stretch and twist to the whole length
        (All, Bending, default All). One of All, Bending.
    :param axis1: Direction of local axis 1. Default: from the first node to the second; +Z for one node.
    :param axis2: Vector in the plane of local axes 1 and 2. Default: the upward direction square to axis 1; +X
        for a vertical one.
    """

    _name = "Beam"
    _words = frozenset({"mass_matrix", "offsets_stiffen", "release_i", "release_j"})

    def __init__(
        self,
        *,
        nodes: Any | None = None,
        node: str | None = None,
        use: Any | None = None,
        young: Quantity | None = None,
        shear_modulus: Quantity | None = None,
        poisson: Quantity | None = None,
        area: Quantity | None = None,
        i2: Quantity | None = None,
        i3: Quantity | None = None,
        torsion: Quantity | None = None,
        width: Quantity | None = None,
        depth: Quantity | None = None,
        shear_area_2: Quantity | None = None,
        shear_area_3: Quantity | None = None,
        shear_coefficient: Quantity | None = None,
        density: Quantity | None = None,
        distributed_mass: Quantity | None = None,
        expansion: Quantity | None = None,
        mass_matrix: Name | None = None,
        release_i: Sequence[Any] | Name | None = None,
        release_j: Sequence[Any] | Name | None = None,
        offset_i: Quantity | None = None,
        offset_j: Quantity | None = None,
        offsets_stiffen: Name | None = None,
        axis1: Any | None = None,
        axis2: Any | None = None,
    ) -> None:
        super().__init__(
            nodes=nodes,
            node=node,
            use=use,
            young=young,
            shear_modulus=shear_modulus,
            poisson=poisson,
            area=area,
            i2=i2,
            i3=i3,
            torsion=torsion,
            width=width,
            depth=depth,
            shear_area_2=shear_area_2,
            shear_area_3=shear_area_3,
            shear_coefficient=shear_coefficient,
            density=density,
            distributed_mass=distributed_mass,
            expansion=expansion,
            mass_matrix=mass_matrix,
            release_i=release_i,
            release_j=release_j,
            offset_i=offset_i,
            offset_j=offset_j,
            offsets_stiffen=offsets_stiffen,
            axis1=axis1,
            axis2=axis2,
        )


class BilinearDamper(Block):
    """Spring in series with an oil damper that has a relief valve. On two nodes, or one and the ground.

    :param nodes: The nodes. Default: `node`.
    :param node: The only node: a link or spring between it and the ground. Default: `nodes`.
    :param use: Parameters from the set; those given beside it come first. Default: none.
    :param k: stiffness of the spring (N/m, > 0).
    :param c: coefficient up to the relief force (N·s/m, > 0).
    :param cy: coefficient beyond the relief force (N·s/m, ≥ 0).
    :param fl: relief force (N, > 0).
    :param axis: local axis (U1, U2, U3, default U1). One of U1, U2, U3.
    :param axis1: Direction of local axis 1. Default: from the first node to the second; +Z for one node.
    :param axis2: Vector in the plane of local axes 1 and 2. Default: the upward direction square to axis 1; +X
        for a vertical one.
    :param effective_stiffness: Stiffness that stands for the link in the linear structure (K effective of FNA).
        The link equations take it out again. Default: 0; the basis is made with a thousandth of the stiffness of
        the closed link.
    :param p_delta_at: Where the moment of the axial force over the shear of the link acts (P-Δ): its share at
        either end, the ground as the first for one node; the rest is a couple of shears, for which the nodes must
        be apart. `(1, 0)` for a bearing whose dish lies below. For laws with U1 and U2 or U3. With `p_delta` or
        without. Default: no such moment.
    :param shear_at: Distance from the second node at which the shear of a link with two nodes acts. Default: `0`.
    """

    _name = "BilinearDamper"
    _words = frozenset({"axis"})

    def __init__(
        self,
        *,
        nodes: Any | None = None,
        node: str | None = None,
        use: Any | None = None,
        k: Quantity | None = None,
        c: Quantity | None = None,
        cy: Quantity | None = None,
        fl: Quantity | None = None,
        axis: Name | None = None,
        axis1: Any | None = None,
        axis2: Any | None = None,
        effective_stiffness: Any | None = None,
        p_delta_at: Any | None = None,
        shear_at: Quantity | None = None,
    ) -> None:
        super().__init__(
            nodes=nodes,
            node=node,
            use=use,
            k=k,
            c=c,
            cy=cy,
            fl=fl,
            axis=axis,
            axis1=axis1,
            axis2=axis2,
            effective_stiffness=effective_stiffness,
            p_delta_at=p_delta_at,
            shear_at=shear_at,
        )


class BodyContact(Block):
    """Contact of two bodies in finite rotation: points on a face, or round bodies side by side. On 2 nodes.

    :param nodes: The nodes. Default: `node`.
    :param node: The only node: a link or spring between it and the ground. Default: `nodes`.
    :param use: Parameters from the set; those given beside it come first. Default: none.
    :param points: points of the second body, from its node, at rest (m, list of (x, y, z), default absent).
    :param face: a point of the first body's face (its middle), from its node (m, 3 numbers, any, default absent).
    :param normal: direction out of the face; none: upwards, (0, 0, 1) (–, 3 numbers, any, default absent).
    :param extent: half widths of the face along its two axes; none: it has no edge (m, 2 numbers, > 0, default
        absent).
    :param radii: instead of points and face: radii of the first and of the second body (m, 2 numbers, > 0,
        default absent).
    :param heights: where the second round body touches, from its node along its axis (m, list, any, default
        absent).
    :param kn: contact stiffness of each point or height (N/m, > 0).
    :param damping: contact dashpot of each point or height, acts only where closed (N·s/m, ≥ 0, default 0).
    :param pull: the dashpot may pull while closed (true, false, default false).
    :param mu: friction coefficient (–, ≥ 0, default 0).
    :param ks: pre-slip stiffness of each point or height; required with friction (N/m, > 0, default absent).
    :param axis1: Direction of local axis 1. Default: from the first node to the second; +Z for one node.
    :param axis2: Vector in the plane of local axes 1 and 2. Default: the upward direction square to axis 1; +X
        for a vertical one.
    :param effective_stiffness: Stiffness that stands for the link in the linear structure (K effective of FNA).
        The link equations take it out again. Default: 0; the basis is made with a thousandth of the stiffness of
        the closed link.
    :param p_delta_at: Where the moment of the axial force over the shear of the link acts (P-Δ): its share at
        either end, the ground as the first for one node; the rest is a couple of shears, for which the nodes must
        be apart. `(1, 0)` for a bearing whose dish lies below. For laws with U1 and U2 or U3. With `p_delta` or
        without. Default: no such moment.
    :param shear_at: Distance from the second node at which the shear of a link with two nodes acts. Default: `0`.
    """

    _name = "BodyContact"

    def __init__(
        self,
        *,
        nodes: Any | None = None,
        node: str | None = None,
        use: Any | None = None,
        points: Sequence[Any] | None = None,
        face: Quantity | Sequence[Any] | None = None,
        normal: Quantity | Sequence[Any] | None = None,
        extent: Quantity | Sequence[Any] | None = None,
        radii: Quantity | Sequence[Any] | None = None,
        heights: Quantity | Sequence[Any] | None = None,
        kn: Quantity | None = None,
        damping: Quantity | None = None,
        pull: bool | str | None = None,
        mu: Quantity | None = None,
        ks: Quantity | None = None,
        axis1: Any | None = None,
        axis2: Any | None = None,
        effective_stiffness: Any | None = None,
        p_delta_at: Any | None = None,
        shear_at: Quantity | None = None,
    ) -> None:
        super().__init__(
            nodes=nodes,
            node=node,
            use=use,
            points=points,
            face=face,
            normal=normal,
            extent=extent,
            radii=radii,
            heights=heights,
            kn=kn,
            damping=damping,
            pull=pull,
            mu=mu,
            ks=ks,
            axis1=axis1,
            axis2=axis2,
            effective_stiffness=effective_stiffness,
            p_delta_at=p_delta_at,
            shear_at=shear_at,
        )


class BoucWen(Block):
    """Smooth hysteretic spring that loses strength and stiffness (Bouc, Wen, Baber). On two nodes, or one and the
    ground.

    :param nodes: The nodes. Default: `node`.
    :param node: The only node: a link or spring between it and the ground. Default: `nodes`.
    :param use: Parameters from the set; those given beside it come first. Default: none.
    :param k: stiffness at rest (where A₀ = 1) (N/m or N·m, > 0).
    :param dy: deformation that z counts in; at yield where β + γ = A₀ = 1 (m or –, > 0).
    :param alpha: stiffness after yielding over `k` (–, between 0 and 1).
    :param n: sharpness of yielding (–, between 1 and 50, default 2).
    :param beta: shape: loading against β + γ, return with β − γ (–, > 0, default 0.5).
    :param gamma: shape, −β < γ ≤ β; at γ = β the return is elastic (–, any, default 0.5).
    :param a0: stiffness of z at rest (–, > 0, default 1).
    :param delta_a: loss of stiffness and strength with ε (–, ≥ 0, default 0).
    :param delta_nu: loss of strength with ε (–, ≥ 0, default 0).
    :param delta_eta: loss of stiffness with ε (–, ≥ 0, default 0).
    :param axis: local axis (U1, U2, U3, R1, R2, R3, default U1). One of U1, U2, U3, R1, R2, R3.
    :param axis1: Direction of local axis 1. Default: from the first node to the second; +Z for one node.
    :param axis2: Vector in the plane of local axes 1 and 2. Default: the upward direction square to axis 1; +X
        for a vertical one.
    :param effective_stiffness: Stiffness that stands for the link in the linear structure (K effective of FNA).
        The link equations take it out again. Default: 0; the basis is made with a thousandth of the stiffness of
        the closed link.
    :param p_delta_at: Where the moment of the axial force over the shear of the link acts (P-Δ): its share at
        either end, the ground as the first for one node; the rest is a couple of shears, for which the nodes must
        be apart. `(1, 0)` for a bearing whose dish lies below. For laws with U1 and U2 or U3. With `p_delta` or
        without. Default: no such moment.
    :param shear_at: Distance from the second node at which the shear of a link with two nodes acts. Default: `0`.
    """

    _name = "BoucWen"
    _words = frozenset({"axis"})

    def __init__(
        self,
        *,
        nodes: Any | None = None,
        node: str | None = None,
        use: Any | None = None,
        k: Quantity | None = None,
        dy: Quantity | None = None,
        alpha: Quantity | None = None,
        n: Quantity | None = None,
        beta: Quantity | None = None,
        gamma: Quantity | None = None,
        a0: Quantity | None = None,
        delta_a: Quantity | None = None,
        delta_nu: Quantity | None = None,
        delta_eta: Quantity | None = None,
        axis: Name | None = None,
        axis1: Any | None = None,
        axis2: Any | None = None,
        effective_stiffness: Any | None = None,
        p_delta_at: Any | None = None,
        shear_at: Quantity | None = None,
    ) -> None:
        super().__init__(
            nodes=nodes,
            node=node,
            use=use,
            k=k,
            dy=dy,
            alpha=alpha,
            n=n,
            beta=beta,
            gamma=gamma,
            a0=a0,
            delta_a=delta_a,
            delta_nu=delta_nu,
            delta_eta=delta_eta,
            axis=axis,
            axis1=axis1,
            axis2=axis2,
            effective_stiffness=effective_stiffness,
            p_delta_at=p_delta_at,
            shear_at=shear_at,
        )


class Box(Block):
    """A hollow box with sharp corners.

    :param width: Outer width, along local 3.
    :param depth: Outer depth, along local 2.
    :param thickness: Of the walls along the depth.
    :param flange: Of the walls along the width. Default: `thickness`.
    """

    _name = "Box"

    def __init__(
        self,
        *,
        width: Quantity | None = None,
        depth: Quantity | None = None,
        thickness: Quantity | None = None,
        flange: Quantity | None = None,
    ) -> None:
        super().__init__(
            width=width,
            depth=depth,
            thickness=thickness,
            flange=flange,
        )


class Butterworth(Block):
    """Butterworth filter; with both corners a band-pass.

    :param highpass: Corner below which motion is taken out. Default: for `lowpass` alone.
    :param lowpass: Corner above which motion is taken out. Default: none.
    :param order: Order. Default: `4`.
    :param causal: Forward only; else forward and backward, without shift of phase. Default: `false`.
    :param padding: Zeros around the record: none, taken off again, or kept. One of None, Strip, Keep. Default:
        `Strip`.
    """

    _name = "Butterworth"
    _words = frozenset({"padding"})

    def __init__(
        self,
        *,
        highpass: Quantity | None = None,
        lowpass: Quantity | None = None,
        order: int | str | None = None,
        causal: bool | str | None = None,
        padding: Name | None = None,
    ) -> None:
        super().__init__(
            highpass=highpass,
            lowpass=lowpass,
            order=order,
            causal=causal,
            padding=padding,
        )


class Circle(Block):
    """A solid circle.

    :param diameter: Diameter.
    """

    _name = "Circle"

    def __init__(
        self,
        *,
        diameter: Quantity | None = None,
    ) -> None:
        super().__init__(
            diameter=diameter,
        )


class Complete(Block):
    """All eigenvectors: no reduction."""

    _name = "Complete"


class Concrete(Block):
    """Reinforced concrete, uncracked. `Concrete("C30/37")` names the class alone.

    :param class_: Class of EN 1992-1-1, table 3.1: E = 22 GPa (f_cm/10 MPa)^0.3, f_cm = f_ck + 8 MPa. Default:
        `strength`.
    :param strength: Cylinder strength f'c instead: E = 4700 MPa √(f'c/MPa) (ACI 318-19, 19.2.2.1). Default:
        `class`.
    :param poisson: Poisson's ratio. Default: `0.2`.
    :param density: Density, with steel. Default: `"2500 kg/m^3"`.
    :param expansion: Strain by one kelvin. Default: `1e-5`.
    """

    _name = "Concrete"

    def __init__(
        self,
        *,
        class_: Any | None = None,
        strength: Quantity | None = None,
        poisson: Quantity | None = None,
        density: Quantity | None = None,
        expansion: Quantity | None = None,
    ) -> None:
        super().__init__(
            strength=strength,
            poisson=poisson,
            density=density,
            expansion=expansion,
            **{"class": class_},
        )


class Constant(Block):
    """The same value at all times; `Constant(3)` will do.

    :param value: The value.
    """

    _name = "Constant"

    def __init__(
        self,
        *,
        value: Quantity | None = None,
    ) -> None:
        super().__init__(
            value=value,
        )


class Cosine(Block):
    """amplitude · cos(2π frequency (t − start) + phase).

    :param amplitude: Largest value; its unit is the unit of the function.
    :param frequency: Cycles per second.
    :param cycles: Cycles after which it is zero; 0.5 is a half sine. Default: no end.
    :param start: Time at which it begins; zero before. Default: `0`.
    :param phase: Phase at the start, an angle. Default: `0`.
    """

    _name = "Cosine"

    def __init__(
        self,
        *,
        amplitude: Quantity | None = None,
        frequency: Quantity | None = None,
        cycles: Quantity | None = None,
        start: Quantity | None = None,
        phase: Quantity | None = None,
    ) -> None:
        super().__init__(
            amplitude=amplitude,
            frequency=frequency,
            cycles=cycles,
            start=start,
            phase=phase,
        )


class Dashpot(Block):
    """Dashpot with a power of the rate, acting always or in contact only. On two nodes, or one and the ground.

    :param nodes: The nodes. Default: `node`.
    :param node: The only node: a link or spring between it and the ground. Default: `nodes`.
    :param use: Parameters from the set; those given beside it come first. Default: none.
    :param c: coefficient along U1, U2 or U3 (N/(m/s)^exponent, > 0, default absent).
    :param cr: instead of `c`: coefficient about R1, R2 or R3 (N·m/(1/s)^exponent, > 0, default absent).
    :param exponent: exponent of the rate (–, > 0 and ≤ 2, default 1).
    :param axis: local axis (U1, U2, U3, R1, R2, R3, default U1). One of U1, U2, U3, R1, R2, R3.
    :param when: when it acts (Always, InContact, default Always). One of Always, InContact.
    :param opening: clearance of the contact (m, any, default 0).
    :param stiffness: spring of the contact (N/m, ≥ 0, default 0).
    :param restitution: instead of `c`, in contact: speed after over speed before an impact (–, > 0 and ≤ 1,
        default absent).
    :param impact_mass: mass that strikes, for `restitution`; none: worked out from the structure (kg, > 0,
        default absent).
    :param pull: the total force may pull while closed (true, false, default false).
    :param linear_below: rate below which α < 1 is linear (rad/s with `cr`) (m/s, > 0, default 0.000001).
    :param axis1: Direction of local axis 1. Default: from the first node to the second; +Z for one node.
    :param axis2: Vector in the plane of local axes 1 and 2. Default: the upward direction square to axis 1; +X
        for a vertical one.
    :param effective_stiffness: Stiffness that stands for the link in the linear structure (K effective of FNA).
        The link equations take it out again. Default: 0; the basis is made with a thousandth of the stiffness of
        the closed link.
    :param p_delta_at: Where the moment of the axial force over the shear of the link acts (P-Δ): its share at
        either end, the ground as the first for one node; the rest is a couple of shears, for which the nodes must
        be apart. `(1, 0)` for a bearing whose dish lies below. For laws with U1 and U2 or U3. With `p_delta` or
        without. Default: no such moment.
    :param shear_at: Distance from the second node at which the shear of a link with two nodes acts. Default: `0`.
    """

    _name = "Dashpot"
    _words = frozenset({"axis", "when"})

    def __init__(
        self,
        *,
        nodes: Any | None = None,
        node: str | None = None,
        use: Any | None = None,
        c: Quantity | None = None,
        cr: Quantity | None = None,
        exponent: Quantity | None = None,
        axis: Name | None = None,
        when: Name | None = None,
        opening: Quantity | None = None,
        stiffness: Quantity | None = None,
        restitution: Quantity | None = None,
        impact_mass: Quantity | None = None,
        pull: bool | str | None = None,
        linear_below: Quantity | None = None,
        axis1: Any | None = None,
        axis2: Any | None = None,
        effective_stiffness: Any | None = None,
        p_delta_at: Any | None = None,
        shear_at: Quantity | None = None,
    ) -> None:
        super().__init__(
            nodes=nodes,
            node=node,
            use=use,
            c=c,
            cr=cr,
            exponent=exponent,
            axis=axis,
            when=when,
            opening=opening,
            stiffness=stiffness,
            restitution=restitution,
            impact_mass=impact_mass,
            pull=pull,
            linear_below=linear_below,
            axis1=axis1,
            axis2=axis2,
            effective_stiffness=effective_stiffness,
            p_delta_at=p_delta_at,
            shear_at=shear_at,
        )


class Diaphragm(Block):
    """Floor that is rigid in its plane; the first node leads, the others follow. On 2 nodes or more.

    :param nodes: The nodes. Default: `node`.
    :param node: The only node: a link or spring between it and the ground. Default: `nodes`.
    :param use: Parameters from the set; those given beside it come first. Default: none.
    :param normal: direction normal to the floor (X, Y, Z, default Z). One of X, Y, Z.
    :param axis1: Direction of local axis 1. Default: from the first node to the second; +Z for one node.
    :param axis2: Vector in the plane of local axes 1 and 2. Default: the upward direction square to axis 1; +X
        for a vertical one.
    """

    _name = "Diaphragm"
    _words = frozenset({"normal"})

    def __init__(
        self,
        *,
        nodes: Any | None = None,
        node: str | None = None,
        use: Any | None = None,
        normal: Name | None = None,
        axis1: Any | None = None,
        axis2: Any | None = None,
    ) -> None:
        super().__init__(
            nodes=nodes,
            node=node,
            use=use,
            normal=normal,
            axis1=axis1,
            axis2=axis2,
        )


class Displacement(Block):
    """Displacement or rotation, relative to the base.

    :param node: The node. Default: `terms`.
    :param dof: Direction. One of Ux, Uy, Uz, Rx, Ry, Rz. Default: `terms`.
    :param factor: Factor, with or without unit. Default: `1`.
    :param terms: Several terms that are added, such as a drift; in place of `node` and `dof`. Default: a single
        term.
    :param hidden: Other outputs are made from it, and it is left out of files, report and summary. Default:
        `false`.
    """

    _name = "Displacement"
    _words = frozenset({"dof"})

    def __init__(
        self,
        *,
        node: str | None = None,
        dof: Name | None = None,
        factor: Quantity | None = None,
        terms: Sequence[Any] | None = None,
        hidden: bool | str | None = None,
    ) -> None:
        super().__init__(
            node=node,
            dof=dof,
            factor=factor,
            terms=terms,
            hidden=hidden,
        )


class Dynamic(Block):
    """Motion in time.

    :param after: Earlier case whose end is the start: displacements, link histories and loads are carried on.
        Default: from rest, unloaded.
    :param duration: Length of the analysis.
    :param dt: Output step; the march takes substeps in it by itself.
    :param constant: Loads that act unchanged from the start, beside those carried on. Default: `[]`.
    :param base: Acceleration of the ground. Default: `[]`.
    :param forces: Forces that vary. Default: `[]`.
    :param supports: Supports that move. Default: `[]`.
    :param initial: Values at the start. Default: `[]`.
    :param solver: Solver, where `--solver` names none. One of Fna, Hht, RitzHht, FullNewton. Default: `Fna`.
    :param step: Step control. Default: `Adaptive`.
    :param kernel: Solution of the link equations: Newton with full tangents, or the constant-stiffness iteration
        of Wilson. One of Newton, FixedPoint. Default: `Newton`.
    :param link_tolerance: Share of the largest link force by which a link may miss equilibrium. Default: `1e-9`.
    :param energy_limit: Share of the energy that may be unaccounted for before the run says so. Default: `1e-3`.
    :param substep_limit: Substeps that may be tried in all; a run that needs more ends there with what it has.
        Default: 1 000 000, or 200 for each output step.
    :param basis: Basis of `Fna` and `RitzHht`. Default: `Ritz`.
    :param alpha: α of HHT; 0 is the average acceleration method. Default: `0`.
    """

    _name = "Dynamic"
    _words = frozenset({"basis", "kernel", "solver", "step"})

    def __init__(
        self,
        *,
        after: str | None = None,
        duration: Quantity | None = None,
        dt: Quantity | None = None,
        constant: Sequence[Any] | None = None,
        base: Sequence[Any] | None = None,
        forces: Sequence[Any] | None = None,
        supports: Sequence[Any] | None = None,
        initial: Sequence[Any] | None = None,
        solver: Name | None = None,
        step: Name | Block | Mapping[str, Any] | None = None,
        kernel: Name | None = None,
        link_tolerance: Quantity | None = None,
        energy_limit: Quantity | None = None,
        substep_limit: int | str | None = None,
        basis: Name | Block | Mapping[str, Any] | None = None,
        alpha: Quantity | None = None,
    ) -> None:
        super().__init__(
            after=after,
            duration=duration,
            dt=dt,
            constant=constant,
            base=base,
            forces=forces,
            supports=supports,
            initial=initial,
            solver=solver,
            step=step,
            kernel=kernel,
            link_tolerance=link_tolerance,
            energy_limit=energy_limit,
            substep_limit=substep_limit,
            basis=basis,
            alpha=alpha,
        )


class Eigen(Block):
    """Exact eigenvectors, and a static vector for link coordinates that they hold badly.

    :param vectors: How many vectors. Default: chosen by the program.
    :param adequacy: Share of the exact flexibility at every link coordinate that the basis must hold; 0: no
        vectors for links. Default: `0.99`.
    :param tolerance: Error that the reduction may make in any output, as share of its range; estimated in every
        run, but not where it is 1. Default: `0.02`.
    :param enrich: A basis that makes a larger error is enlarged and the run made again; false: the run ends as
        inadequate. Default: `true`.
    """

    _name = "Eigen"

    def __init__(
        self,
        *,
        vectors: int | str | None = None,
        adequacy: Quantity | None = None,
        tolerance: Quantity | None = None,
        enrich: bool | str | None = None,
    ) -> None:
        super().__init__(
            vectors=vectors,
            adequacy=adequacy,
            tolerance=tolerance,
            enrich=enrich,
        )


class ElastomericBearing(Block):
    """Bearing with bilinear shear coupled in its plane, of plasticity theory. On two nodes, or one and the ground.

    :param nodes: The nodes. Default: `node`.
    :param node: The only node: a link or spring between it and the ground. Default: `nodes`.
    :param use: Parameters from the set; those given beside it come first. Default: none.
    :param k: shear stiffness before yielding (N/m, > 0).
    :param fy: shear force at which it yields (N, > 0).
    :param ratio: stiffness after yielding over `k`, below 1 (–, between 0 and 1, default 0).
    :param axis1: Direction of local axis 1. Default: from the first node to the second; +Z for one node.
    :param axis2: Vector in the plane of local axes 1 and 2. Default: the upward direction square to axis 1; +X
        for a vertical one.
    :param effective_stiffness: Stiffness that stands for the link in the linear structure (K effective of FNA).
        The link equations take it out again. Default: 0; the basis is made with a thousandth of the stiffness of
        the closed link.
    :param p_delta_at: Where the moment of the axial force over the shear of the link acts (P-Δ): its share at
        either end, the ground as the first for one node; the rest is a couple of shears, for which the nodes must
        be apart. `(1, 0)` for a bearing whose dish lies below. For laws with U1 and U2 or U3. With `p_delta` or
        without. Default: no such moment.
    :param shear_at: Distance from the second node at which the shear of a link with two nodes acts. Default: `0`.
    """

    _name = "ElastomericBearing"

    def __init__(
        self,
        *,
        nodes: Any | None = None,
        node: str | None = None,
        use: Any | None = None,
        k: Quantity | None = None,
        fy: Quantity | None = None,
        ratio: Quantity | None = None,
        axis1: Any | None = None,
        axis2: Any | None = None,
        effective_stiffness: Any | None = None,
        p_delta_at: Any | None = None,
        shear_at: Quantity | None = None,
    ) -> None:
        super().__init__(
            nodes=nodes,
            node=node,
            use=use,
            k=k,
            fy=fy,
            ratio=ratio,
            axis1=axis1,
            axis2=axis2,
            effective_stiffness=effective_stiffness,
            p_delta_at=p_delta_at,
            shear_at=shear_at,
        )


class ElementForce(Block):
    """Force of a linear element on one of its nodes, along global directions.

    :param element: The element.
    :param end: Its node, from 0.
    :param dof: Direction. One of Ux, Uy, Uz, Rx, Ry, Rz.
    :param factor: Factor, with or without unit. Default: `1`.
    :param hidden: Other outputs are made from it, and it is left out of files, report and summary. Default:
        `false`.
    """

    _name = "ElementForce"
    _words = frozenset({"dof"})

    def __init__(
        self,
        *,
        element: str | None = None,
        end: int | str | None = None,
        dof: Name | None = None,
        factor: Quantity | None = None,
        hidden: bool | str | None = None,
    ) -> None:
        super().__init__(
            element=element,
            end=end,
            dof=dof,
            factor=factor,
            hidden=hidden,
        )


class Envelope(Block):
    """Largest of the largest values and smallest of the smallest, and which case they come from.

    :param cases: Cases, and combinations that stand before, with their factors; names in a list have the factor
        1.
    """

    _name = "Envelope"

    def __init__(
        self,
        *,
        cases: Any | None = None,
    ) -> None:
        super().__init__(
            cases=cases,
        )


class EqualDof(Block):
    """Chosen DOFs of the other nodes equal those of the first. On 2 nodes or more.

    :param nodes: The nodes. Default: `node`.
    :param node: The only node: a link or spring between it and the ground. Default: `nodes`.
    :param use: Parameters from the set; those given beside it come first. Default: none.
    :param dofs: which DOFs (some of Ux, Uy, Uz, Rx, Ry, Rz). One of Ux, Uy, Uz, Rx, Ry, Rz.
    :param axis1: Direction of local axis 1. Default: from the first node to the second; +Z for one node.
    :param axis2: Vector in the plane of local axes 1 and 2. Default: the upward direction square to axis 1; +X
        for a vertical one.
    """

    _name = "EqualDof"
    _words = frozenset({"dofs"})

    def __init__(
        self,
        *,
        nodes: Any | None = None,
        node: str | None = None,
        use: Any | None = None,
        dofs: Sequence[Any] | Name | None = None,
        axis1: Any | None = None,
        axis2: Any | None = None,
    ) -> None:
        super().__init__(
            nodes=nodes,
            node=node,
            use=use,
            dofs=dofs,
            axis1=axis1,
            axis2=axis2,
        )


class Fixed(Block):
    """Equal substeps, halved only where the link equations do not converge.

    :param substeps: Substeps in an output step. Default: `1`.
    """

    _name = "Fixed"

    def __init__(
        self,
        *,
        substeps: int | str | None = None,
    ) -> None:
        super().__init__(
            substeps=substeps,
        )


class For(Block):
    """Repeats `of` for all values of its indices, the last index running fastest. Any other name among the fields is
    an index; it takes `"0 to 4"` (both ends included, with expressions such as `"1 to storeys"`), a list of
    values, or a map from what stands in names to values.

    :param of: What is repeated.
    :param when: Which repetitions are made. Default: always.
    """

    _name = "For"

    def __init__(
        self,
        *,
        of: Any | None = None,
        when: Any | None = None,
        **more: Any,
    ) -> None:
        super().__init__(
            of=of,
            when=when,
            **more,
        )


class FrequencyIndependentViscoelastic(Block):
    """Viscoelastic damper with a near-constant loss factor: springs and Maxwell branches. On two nodes, or one and
    the ground.

    :param nodes: The nodes. Default: `node`.
    :param node: The only node: a link or spring between it and the ground. Default: `nodes`.
    :param use: Parameters from the set; those given beside it come first. Default: none.
    :param k: storage stiffness at √(f_min f_max) (N/m or N·m, > 0, default absent).
    :param loss_factor: loss factor in the band (–, > 0 and ≤ 2, default absent).
    :param f_min: lower end of the band (1/s, > 0, default absent).
    :param f_max: upper end of the band (1/s, > 0, default absent).
    :param k_inf: instead: stiffness beside the branches (N/m or N·m, ≥ 0, default absent).
    :param stiffness: instead: stiffnesses of the branches (N/m or N·m, list, ≥ 0, default absent).
    :param time: instead: relaxation times of the branches (s, list, > 0, default absent).
    :param axis: local axis (U1, U2, U3, R1, R2, R3, default U1). One of U1, U2, U3, R1, R2, R3.
    :param axis1: Direction of local axis 1. Default: from the first node to the second; +Z for one node.
    :param axis2: Vector in the plane of local axes 1 and 2. Default: the upward direction square to axis 1; +X
        for a vertical one.
    :param effective_stiffness: Stiffness that stands for the link in the linear structure (K effective of FNA).
        The link equations take it out again. Default: 0; the basis is made with a thousandth of the stiffness of
        the closed link.
    :param p_delta_at: Where the moment of the axial force over the shear of the link acts (P-Δ): its share at
        either end, the ground as the first for one node; the rest is a couple of shears, for which the nodes must
        be apart. `(1, 0)` for a bearing whose dish lies below. For laws with U1 and U2 or U3. With `p_delta` or
        without. Default: no such moment.
    :param shear_at: Distance from the second node at which the shear of a link with two nodes acts. Default: `0`.
    """

    _name = "FrequencyIndependentViscoelastic"
    _words = frozenset({"axis"})

    def __init__(
        self,
        *,
        nodes: Any | None = None,
        node: str | None = None,
        use: Any | None = None,
        k: Quantity | None = None,
        loss_factor: Quantity | None = None,
        f_min: Quantity | None = None,
        f_max: Quantity | None = None,
        k_inf: Quantity | None = None,
        stiffness: Quantity | Sequence[Any] | None = None,
        time: Quantity | Sequence[Any] | None = None,
        axis: Name | None = None,
        axis1: Any | None = None,
        axis2: Any | None = None,
        effective_stiffness: Any | None = None,
        p_delta_at: Any | None = None,
        shear_at: Quantity | None = None,
    ) -> None:
        super().__init__(
            nodes=nodes,
            node=node,
            use=use,
            k=k,
            loss_factor=loss_factor,
            f_min=f_min,
            f_max=f_max,
            k_inf=k_inf,
            stiffness=stiffness,
            time=time,
            axis=axis,
            axis1=axis1,
            axis2=axis2,
            effective_stiffness=effective_stiffness,
            p_delta_at=p_delta_at,
            shear_at=shear_at,
        )


class FrictionPendulum(Block):
    """Sliding bearing with one concave surface: friction by speed, force or pressure; rim. On two nodes, or one and
    the ground.

    :param nodes: The nodes. Default: `node`.
    :param node: The only node: a link or spring between it and the ground. Default: `nodes`.
    :param use: Parameters from the set; those given beside it come first. Default: none.
    :param kn: stiffness in compression (N/m, > 0).
    :param damping: dashpot along the axis, acts only while closed (N·s/m, ≥ 0, default 0).
    :param pull: the dashpot may pull while closed; friction is of kₙ g then (true, false, default false).
    :param ks: stiffness before slip (N/m, > 0).
    :param cs: dashpot beside the spring `ks`: damps a bearing that sticks (N·s/m, ≥ 0, default 0).
    :param mu_static: before it breaks away; none: as at rest (–, ≥ 0, default absent).
    :param static_slip: slip over which `mu_static` is gone; 0: as soon as the spring `ks` can follow (m, ≥ 0,
        default 0).
    :param radius: effective radius; 0 is flat (m, ≥ 0, default 0).
    :param surface: restoring force of small slopes, or exact (Shallow, Spherical, default Shallow). One of
        Shallow, Spherical.
    :param rise: moving out lifts the load (true, false, default false).
    :param inclined: friction lies in the surface, of the force normal to it; exact with `Spherical` and `rise`
        (true, false, default false).
    :param friction_model: what the friction coefficient depends on (Coulomb, Velocity, VelocityForce,
        VelocityPressure, default Coulomb). One of Coulomb, Velocity, VelocityForce, VelocityPressure.
    :param mu: Coulomb: friction coefficient (–, ≥ 0, default absent).
    :param mu_slow: Velocity, VelocityPressure: coefficient at rest (–, ≥ 0, default absent).
    :param mu_fast: Velocity, VelocityPressure: coefficient at speed (–, ≥ 0, default absent).
    :param rate: Velocity, VelocityPressure: how fast it goes from slow to fast (s/m, ≥ 0, default absent).
    :param a_slow: VelocityForce: factor at rest (N/(N)^n_slow, ≥ 0, default absent).
    :param n_slow: VelocityForce: exponent at rest; 1 is no dependence (–, > 0 and ≤ 1, default absent).
    :param a_fast: VelocityForce: factor at speed (N/(N)^n_fast, ≥ 0, default absent).
    :param n_fast: VelocityForce: exponent at speed (–, > 0 and ≤ 1, default absent).
    :param rate_0: VelocityForce: rate from slow to fast (s/m, ≥ 0, default absent).
    :param rate_1: VelocityForce: growth of the rate with N (kg^-1·m^-2·s^3, ≥ 0, default 0).
    :param rate_2: VelocityForce: growth of the rate with N² (kg^-2·m^-3·s^5, ≥ 0, default 0).
    :param mu_max: VelocityForce: most that the coefficient becomes at small N (–, > 0, default 1).
    :param area: VelocityPressure: area of the slider (m², > 0, default absent).
    :param delta_mu: VelocityPressure: fall of the coefficient at speed (–, ≥ 0, default absent).
    :param pressure_rate: VelocityPressure: how fast it falls with the pressure (kg^-1·m·s^2, ≥ 0, default
        absent).
    :param stop: displacement at which the rim is met; none: no rim (m, > 0, default absent).
    :param stop_stiffness: stiffness of the rim (N/m, > 0, default absent).
    :param axis1: Direction of local axis 1. Default: from the first node to the second; +Z for one node.
    :param axis2: Vector in the plane of local axes 1 and 2. Default: the upward direction square to axis 1; +X
        for a vertical one.
    :param effective_stiffness: Stiffness that stands for the link in the linear structure (K effective of FNA).
        The link equations take it out again. Default: 0; the basis is made with a thousandth of the stiffness of
        the closed link.
    :param p_delta_at: Where the moment of the axial force over the shear of the link acts (P-Δ): its share at
        either end, the ground as the first for one node; the rest is a couple of shears, for which the nodes must
        be apart. `(1, 0)` for a bearing whose dish lies below. For laws with U1 and U2 or U3. With `p_delta` or
        without. Default: no such moment.
    :param shear_at: Distance from the second node at which the shear of a link with two nodes acts. Default: `0`.
    """

    _name = "FrictionPendulum"
    _words = frozenset({"friction_model", "surface"})

    def __init__(
        self,
        *,
        nodes: Any | None = None,
        node: str | None = None,
        use: Any | None = None,
        kn: Quantity | None = None,
        damping: Quantity | None = None,
        pull: bool | str | None = None,
        ks: Quantity | None = None,
        cs: Quantity | None = None,
        mu_static: Quantity | None = None,
        static_slip: Quantity | None = None,
        radius: Quantity | None = None,
        surface: Name | None = None,
        rise: bool | str | None = None,
        inclined: bool | str | None = None,
        friction_model: Name | None = None,
        mu: Quantity | None = None,
        mu_slow: Quantity | None = None,
        mu_fast: Quantity | None = None,
        rate: Quantity | None = None,
        a_slow: Quantity | None = None,
        n_slow: Quantity | None = None,
        a_fast: Quantity | None = None,
        n_fast: Quantity | None = None,
        rate_0: Quantity | None = None,
        rate_1: Quantity | None = None,
        rate_2: Quantity | None = None,
        mu_max: Quantity | None = None,
        area: Quantity | None = None,
        delta_mu: Quantity | None = None,
        pressure_rate: Quantity | None = None,
        stop: Quantity | None = None,
        stop_stiffness: Quantity | None = None,
        axis1: Any | None = None,
        axis2: Any | None = None,
        effective_stiffness: Any | None = None,
        p_delta_at: Any | None = None,
        shear_at: Quantity | None = None,
    ) -> None:
        super().__init__(
            nodes=nodes,
            node=node,
            use=use,
            kn=kn,
            damping=damping,
            pull=pull,
            ks=ks,
            cs=cs,
            mu_static=mu_static,
            static_slip=static_slip,
            radius=radius,
            surface=surface,
            rise=rise,
            inclined=inclined,
            friction_model=friction_model,
            mu=mu,
            mu_slow=mu_slow,
            mu_fast=mu_fast,
            rate=rate,
            a_slow=a_slow,
            n_slow=n_slow,
            a_fast=a_fast,
            n_fast=n_fast,
            rate_0=rate_0,
            rate_1=rate_1,
            rate_2=rate_2,
            mu_max=mu_max,
            area=area,
            delta_mu=delta_mu,
            pressure_rate=pressure_rate,
            stop=stop,
            stop_stiffness=stop_stiffness,
            axis1=axis1,
            axis2=axis2,
            effective_stiffness=effective_stiffness,
            p_delta_at=p_delta_at,
            shear_at=shear_at,
        )


class FrictionSpring(Block):
    """Ring spring: flag-shaped, self-centring, independent of rates. On two nodes, or one and the ground.

    :param nodes: The nodes. Default: `node`.
    :param node: The only node: a link or spring between it and the ground. Default: `nodes`.
    :param use: Parameters from the set; those given beside it come first. Default: none.
    :param k: stiffness before slip, and between the branches (N/m or N·m, > 0).
    :param k1: stiffness in slip, loading; below `k` (N/m or N·m, > 0).
    :param k2: stiffness in slip, unloading; at most `k1` (N/m or N·m, > 0).
    :param u0: precompression (SAP2000 writes it negative) (m or –, ≥ 0, default 0).
    :param us: deformation at which the rings are closed; none: they never are (m or –, > 0, default absent).
    :param direction: sides on which it acts (Both, Tension, Compression, default Both). One of Both, Tension,
        Compression.
    :param axis: local axis (U1, U2, U3, R1, R2, R3, default U1). One of U1, U2, U3, R1, R2, R3.
    :param axis1: Direction of local axis 1. Default: from the first node to the second; +Z for one node.
    :param axis2: Vector in the plane of local axes 1 and 2. Default: the upward direction square to axis 1; +X
        for a vertical one.
    :param effective_stiffness: Stiffness that stands for the link in the linear structure (K effective of FNA).
        The link equations take it out again. Default: 0; the basis is made with a thousandth of the stiffness of
        the closed link.
    :param p_delta_at: Where the moment of the axial force over the shear of the link acts (P-Δ): its share at
        either end, the ground as the first for one node; the rest is a couple of shears, for which the nodes must
        be apart. `(1, 0)` for a bearing whose dish lies below. For laws with U1 and U2 or U3. With `p_delta` or
        without. Default: no such moment.
    :param shear_at: Distance from the second node at which the shear of a link with two nodes acts. Default: `0`.
    """

    _name = "FrictionSpring"
    _words = frozenset({"axis", "direction"})

    def __init__(
        self,
        *,
        nodes: Any | None = None,
        node: str | None = None,
        use: Any | None = None,
        k: Quantity | None = None,
        k1: Quantity | None = None,
        k2: Quantity | None = None,
        u0: Quantity | None = None,
        us: Quantity | None = None,
        direction: Name | None = None,
        axis: Name | None = None,
        axis1: Any | None = None,
        axis2: Any | None = None,
        effective_stiffness: Any | None = None,
        p_delta_at: Any | None = None,
        shear_at: Quantity | None = None,
    ) -> None:
        super().__init__(
            nodes=nodes,
            node=node,
            use=use,
            k=k,
            k1=k1,
            k2=k2,
            u0=u0,
            us=us,
            direction=direction,
            axis=axis,
            axis1=axis1,
            axis2=axis2,
            effective_stiffness=effective_stiffness,
            p_delta_at=p_delta_at,
            shear_at=shear_at,
        )


class Gap(Block):
    """Compression-only stop with a clearance. On two nodes, or one and the ground.

    :param nodes: The nodes. Default: `node`.
    :param node: The only node: a link or spring between it and the ground. Default: `nodes`.
    :param use: Parameters from the set; those given beside it come first. Default: none.
    :param k: stiffness (N/m, > 0).
    :param opening: clearance at rest (negative: prestressed by k g) (m, any, default 0).
    :param axis: local axis (U1, U2, U3, default U1). One of U1, U2, U3.
    :param axis1: Direction of local axis 1. Default: from the first node to the second; +Z for one node.
    :param axis2: Vector in the plane of local axes 1 and 2. Default: the upward direction square to axis 1; +X
        for a vertical one.
    :param effective_stiffness: Stiffness that stands for the link in the linear structure (K effective of FNA).
        The link equations take it out again. Default: 0; the basis is made with a thousandth of the stiffness of
        the closed link.
    :param p_delta_at: Where the moment of the axial force over the shear of the link acts (P-Δ): its share at
        either end, the ground as the first for one node; the rest is a couple of shears, for which the nodes must
        be apart. `(1, 0)` for a bearing whose dish lies below. For laws with U1 and U2 or U3. With `p_delta` or
        without. Default: no such moment.
    :param shear_at: Distance from the second node at which the shear of a link with two nodes acts. Default: `0`.
    """

    _name = "Gap"
    _words = frozenset({"axis"})

    def __init__(
        self,
        *,
        nodes: Any | None = None,
        node: str | None = None,
        use: Any | None = None,
        k: Quantity | None = None,
        opening: Quantity | None = None,
        axis: Name | None = None,
        axis1: Any | None = None,
        axis2: Any | None = None,
        effective_stiffness: Any | None = None,
        p_delta_at: Any | None = None,
        shear_at: Quantity | None = None,
    ) -> None:
        super().__init__(
            nodes=nodes,
            node=node,
            use=use,
            k=k,
            opening=opening,
            axis=axis,
            axis1=axis1,
            axis2=axis2,
            effective_stiffness=effective_stiffness,
            p_delta_at=p_delta_at,
            shear_at=shear_at,
        )


class Gravity(Block):
    """The weight of all masses along −Z.

    :param factor: Multiple of the weight. Default: `1`.
    """

    _name = "Gravity"

    def __init__(
        self,
        *,
        factor: Quantity | None = None,
    ) -> None:
        super().__init__(
            factor=factor,
        )


class HalfSine(Block):
    """A single half wave.

    :param amplitude: Largest value; its unit is the unit of the function.
    :param duration: Length of the half wave.
    :param start: Time at which it begins; zero before. Default: `0`.
    """

    _name = "HalfSine"

    def __init__(
        self,
        *,
        amplitude: Quantity | None = None,
        duration: Quantity | None = None,
        start: Quantity | None = None,
    ) -> None:
        super().__init__(
            amplitude=amplitude,
            duration=duration,
            start=start,
        )


class Hook(Block):
    """Tension-only cable with a slack. On two nodes, or one and the ground.

    :param nodes: The nodes. Default: `node`.
    :param node: The only node: a link or spring between it and the ground. Default: `nodes`.
    :param use: Parameters from the set; those given beside it come first. Default: none.
    :param k: stiffness (N/m, > 0).
    :param opening: clearance at rest (negative: prestressed by k g) (m, any, default 0).
    :param axis: local axis (U1, U2, U3, default U1). One of U1, U2, U3.
    :param axis1: Direction of local axis 1. Default: from the first node to the second; +Z for one node.
    :param axis2: Vector in the plane of local axes 1 and 2. Default: the upward direction square to axis 1; +X
        for a vertical one.
    :param effective_stiffness: Stiffness that stands for the link in the linear structure (K effective of FNA).
        The link equations take it out again. Default: 0; the basis is made with a thousandth of the stiffness of
        the closed link.
    :param p_delta_at: Where the moment of the axial force over the shear of the link acts (P-Δ): its share at
        either end, the ground as the first for one node; the rest is a couple of shears, for which the nodes must
        be apart. `(1, 0)` for a bearing whose dish lies below. For laws with U1 and U2 or U3. With `p_delta` or
        without. Default: no such moment.
    :param shear_at: Distance from the second node at which the shear of a link with two nodes acts. Default: `0`.
    """

    _name = "Hook"
    _words = frozenset({"axis"})

    def __init__(
        self,
        *,
        nodes: Any | None = None,
        node: str | None = None,
        use: Any | None = None,
        k: Quantity | None = None,
        opening: Quantity | None = None,
        axis: Name | None = None,
        axis1: Any | None = None,
        axis2: Any | None = None,
        effective_stiffness: Any | None = None,
        p_delta_at: Any | None = None,
        shear_at: Quantity | None = None,
    ) -> None:
        super().__init__(
            nodes=nodes,
            node=node,
            use=use,
            k=k,
            opening=opening,
            axis=axis,
            axis1=axis1,
            axis2=axis2,
            effective_stiffness=effective_stiffness,
            p_delta_at=p_delta_at,
            shear_at=shear_at,
        )


class IShape(Block):
    """An I section with equal flanges.

    :param depth: Outer depth, along local 2.
    :param width: Of the flanges, along local 3.
    :param web: Thickness of the web.
    :param flange: Thickness of a flange.
    :param radius: Radius at the roots of the web. Default: `0`.
    """

    _name = "IShape"

    def __init__(
        self,
        *,
        depth: Quantity | None = None,
        width: Quantity | None = None,
        web: Quantity | None = None,
        flange: Quantity | None = None,
        radius: Quantity | None = None,
    ) -> None:
        super().__init__(
            depth=depth,
            width=width,
            web=web,
            flange=flange,
            radius=radius,
        )


class IbarraMedinaKrawinkler(Block):
    """Spring of a capped backbone whose strength and stiffness deteriorate with the energy dissipated; peak-oriented
    or pinching. On two nodes, or one and the ground.

    :param nodes: The nodes. Default: `node`.
    :param node: The only node: a link or spring between it and the ground. Default: `nodes`.
    :param use: Parameters from the set; those given beside it come first. Default: none.
    :param k: elastic stiffness (N/m or N·m, > 0).
    :param fy: yield strength (N or N·m, > 0).
    :param capping: capping strength over `fy` (–, between 1 and 100).
    :param plastic: deformation from yield to capping (m or –, > 0).
    :param post_capping: deformation from capping to zero force (m or –, > 0).
    :param residual: residual strength over `fy` (–, between 0 and 1, default 0).
    :param fy_negative: f_y for d < 0 (as for d > 0) (N or N·m, > 0, default absent).
    :param capping_negative: c for d < 0, over f_y there (–, between 1 and 100, default absent).
    :param plastic_negative: δ_p for d < 0 (m or –, > 0, default absent).
    :param post_capping_negative: δ_pc for d < 0 (m or –, > 0, default absent).
    :param residual_negative: r for d < 0 (–, between 0 and 1, default absent).
    :param lambda_s: energy over `fy` that basic strength stands; none: ∞ (m or –, > 0, default absent).
    :param lambda_c: the same of post-capping strength (m or –, > 0, default absent).
    :param lambda_a: the same of accelerated reloading (m or –, > 0, default absent).
    :param lambda_k: the same of the stiffness of unloading (m or –, > 0, default absent).
    :param c_s: exponent of basic strength (–, between 1 and 2, default 1).
    :param c_c: exponent of post-capping strength (–, between 1 and 2, default 1).
    :param c_a: exponent of accelerated reloading (–, between 1 and 2, default 1).
    :param c_k: exponent of the stiffness of unloading (–, between 1 and 2, default 1).
    :param rate_positive: share of β that acts for d > 0 (–, between 0 and 1, default 1).
    :param rate_negative: share of β that acts for d < 0 (–, between 0 and 1, default 1).
    :param form: reloading (PeakOriented, Pinching, default PeakOriented). One of PeakOriented, Pinching.
    :param kappa_f: Pinching: slope to the break point over that to the target (–, between 0 and 1, default
        absent).
    :param kappa_d: Pinching: share of the permanent deformation left at the break point (–, between 0 and 1,
        default absent).
    :param axis: local axis (U1, U2, U3, R1, R2, R3, default U1). One of U1, U2, U3, R1, R2, R3.
    :param axis1: Direction of local axis 1. Default: from the first node to the second; +Z for one node.
    :param axis2: Vector in the plane of local axes 1 and 2. Default: the upward direction square to axis 1; +X
        for a vertical one.
    :param effective_stiffness: Stiffness that stands for the link in the linear structure (K effective of FNA).
        The link equations take it out again. Default: 0; the basis is made with a thousandth of the stiffness of
        the closed link.
    :param p_delta_at: Where the moment of the axial force over the shear of the link acts (P-Δ): its share at
        either end, the ground as the first for one node; the rest is a couple of shears, for which the nodes must
        be apart. `(1, 0)` for a bearing whose dish lies below. For laws with U1 and U2 or U3. With `p_delta` or
        without. Default: no such moment.
    :param shear_at: Distance from the second node at which the shear of a link with two nodes acts. Default: `0`.
    """

    _name = "IbarraMedinaKrawinkler"
    _words = frozenset({"axis", "form"})

    def __init__(
        self,
        *,
        nodes: Any | None = None,
        node: str | None = None,
        use: Any | None = None,
        k: Quantity | None = None,
        fy: Quantity | None = None,
        capping: Quantity | None = None,
        plastic: Quantity | None = None,
        post_capping: Quantity | None = None,
        residual: Quantity | None = None,
        fy_negative: Quantity | None = None,
        capping_negative: Quantity | None = None,
        plastic_negative: Quantity | None = None,
        post_capping_negative: Quantity | None = None,
        residual_negative: Quantity | None = None,
        lambda_s: Quantity | None = None,
        lambda_c: Quantity | None = None,
        lambda_a: Quantity | None = None,
        lambda_k: Quantity | None = None,
        c_s: Quantity | None = None,
        c_c: Quantity | None = None,
        c_a: Quantity | None = None,
        c_k: Quantity | None = None,
        rate_positive: Quantity | None = None,
        rate_negative: Quantity | None = None,
        form: Name | None = None,
        kappa_f: Quantity | None = None,
        kappa_d: Quantity | None = None,
        axis: Name | None = None,
        axis1: Any | None = None,
        axis2: Any | None = None,
        effective_stiffness: Any | None = None,
        p_delta_at: Any | None = None,
        shear_at: Quantity | None = None,
    ) -> None:
        super().__init__(
            nodes=nodes,
            node=node,
            use=use,
            k=k,
            fy=fy,
            capping=capping,
            plastic=plastic,
            post_capping=post_capping,
            residual=residual,
            fy_negative=fy_negative,
            capping_negative=capping_negative,
            plastic_negative=plastic_negative,
            post_capping_negative=post_capping_negative,
            residual_negative=residual_negative,
            lambda_s=lambda_s,
            lambda_c=lambda_c,
            lambda_a=lambda_a,
            lambda_k=lambda_k,
            c_s=c_s,
            c_c=c_c,
            c_a=c_a,
            c_k=c_k,
            rate_positive=rate_positive,
            rate_negative=rate_negative,
            form=form,
            kappa_f=kappa_f,
            kappa_d=kappa_d,
            axis=axis,
            axis1=axis1,
            axis2=axis2,
            effective_stiffness=effective_stiffness,
            p_delta_at=p_delta_at,
            shear_at=shear_at,
        )


class ImpactHertz(Block):
    """Pounding: Hertz spring with nonlinear damping after a clearance. On two nodes, or one and the ground.

    :param nodes: The nodes. Default: `node`.
    :param node: The only node: a link or spring between it and the ground. Default: `nodes`.
    :param use: Parameters from the set; those given beside it come first. Default: none.
    :param k: contact stiffness (N/(m)^exponent, > 0).
    :param exponent: exponent of the penetration (–, between 1 and 3, default 1.5).
    :param model: how it dissipates (Hertzdamp, Jankowski, default Hertzdamp). One of Hertzdamp, Jankowski.
    :param restitution: speed after over speed before an impact (–, > 0 and ≤ 1, default absent).
    :param xi: instead of `restitution`: the damping itself (–, ≥ 0, default absent).
    :param impact_mass: mass that strikes, for `restitution`; none: worked out from the structure (kg, > 0,
        default absent).
    :param opening: clearance at rest (m, any, default 0).
    :param min_speed: Hertzdamp: slower approaches damp as this one does (m/s, > 0, default 0.001).
    :param axis: local axis (U1, U2, U3, default U1). One of U1, U2, U3.
    :param axis1: Direction of local axis 1. Default: from the first node to the second; +Z for one node.
    :param axis2: Vector in the plane of local axes 1 and 2. Default: the upward direction square to axis 1; +X
        for a vertical one.
    :param effective_stiffness: Stiffness that stands for the link in the linear structure (K effective of FNA).
        The link equations take it out again. Default: 0; the basis is made with a thousandth of the stiffness of
        the closed link.
    :param p_delta_at: Where the moment of the axial force over the shear of the link acts (P-Δ): its share at
        either end, the ground as the first for one node; the rest is a couple of shears, for which the nodes must
        be apart. `(1, 0)` for a bearing whose dish lies below. For laws with U1 and U2 or U3. With `p_delta` or
        without. Default: no such moment.
    :param shear_at: Distance from the second node at which the shear of a link with two nodes acts. Default: `0`.
    """

    _name = "ImpactHertz"
    _words = frozenset({"axis", "model"})

    def __init__(
        self,
        *,
        nodes: Any | None = None,
        node: str | None = None,
        use: Any | None = None,
        k: Quantity | None = None,
        exponent: Quantity | None = None,
        model: Name | None = None,
        restitution: Quantity | None = None,
        xi: Quantity | None = None,
        impact_mass: Quantity | None = None,
        opening: Quantity | None = None,
        min_speed: Quantity | None = None,
        axis: Name | None = None,
        axis1: Any | None = None,
        axis2: Any | None = None,
        effective_stiffness: Any | None = None,
        p_delta_at: Any | None = None,
        shear_at: Quantity | None = None,
    ) -> None:
        super().__init__(
            nodes=nodes,
            node=node,
            use=use,
            k=k,
            exponent=exponent,
            model=model,
            restitution=restitution,
            xi=xi,
            impact_mass=impact_mass,
            opening=opening,
            min_speed=min_speed,
            axis=axis,
            axis1=axis1,
            axis2=axis2,
            effective_stiffness=effective_stiffness,
            p_delta_at=p_delta_at,
            shear_at=shear_at,
        )


class ImpactKelvin(Block):
    """Pounding: spring and dashpot in contact after a clearance. On two nodes, or one and the ground.

    :param nodes: The nodes. Default: `node`.
    :param node: The only node: a link or spring between it and the ground. Default: `nodes`.
    :param use: Parameters from the set; those given beside it come first. Default: none.
    :param k: contact stiffness (N/m, > 0).
    :param damping: contact dashpot (N·s/m, ≥ 0, default absent).
    :param restitution: instead of `damping`: speed after over speed before an impact (–, > 0 and ≤ 1, default
        absent).
    :param impact_mass: mass that strikes, for `restitution`; none: worked out from the structure (kg, > 0,
        default absent).
    :param opening: clearance at rest (m, any, default 0).
    :param damps: all the time in contact, or until the penetration turns (Contact, Approach, default Contact).
        One of Contact, Approach.
    :param pull: the force may pull while closed (true, false, default false).
    :param axis: local axis (U1, U2, U3, default U1). One of U1, U2, U3.
    :param axis1: Direction of local axis 1. Default: from the first node to the second; +Z for one node.
    :param axis2: Vector in the plane of local axes 1 and 2. Default: the upward direction square to axis 1; +X
        for a vertical one.
    :param effective_stiffness: Stiffness that stands for the link in the linear structure (K effective of FNA).
        The link equations take it out again. Default: 0; the basis is made with a thousandth of the stiffness of
        the closed link.
    :param p_delta_at: Where the moment of the axial force over the shear of the link acts (P-Δ): its share at
        either end, the ground as the first for one node; the rest is a couple of shears, for which the nodes must
        be apart. `(1, 0)` for a bearing whose dish lies below. For laws with U1 and U2 or U3. With `p_delta` or
        without. Default: no such moment.
    :param shear_at: Distance from the second node at which the shear of a link with two nodes acts. Default: `0`.
    """

    _name = "ImpactKelvin"
    _words = frozenset({"axis", "damps"})

    def __init__(
        self,
        *,
        nodes: Any | None = None,
        node: str | None = None,
        use: Any | None = None,
        k: Quantity | None = None,
        damping: Quantity | None = None,
        restitution: Quantity | None = None,
        impact_mass: Quantity | None = None,
        opening: Quantity | None = None,
        damps: Name | None = None,
        pull: bool | str | None = None,
        axis: Name | None = None,
        axis1: Any | None = None,
        axis2: Any | None = None,
        effective_stiffness: Any | None = None,
        p_delta_at: Any | None = None,
        shear_at: Quantity | None = None,
    ) -> None:
        super().__init__(
            nodes=nodes,
            node=node,
            use=use,
            k=k,
            damping=damping,
            restitution=restitution,
            impact_mass=impact_mass,
            opening=opening,
            damps=damps,
            pull=pull,
            axis=axis,
            axis1=axis1,
            axis2=axis2,
            effective_stiffness=effective_stiffness,
            p_delta_at=p_delta_at,
            shear_at=shear_at,
        )


class Inerter(Block):
    """Force proportional to the relative acceleration of its ends. On two nodes, or one and the ground.

    :param nodes: The nodes. Default: `node`.
    :param node: The only node: a link or spring between it and the ground. Default: `nodes`.
    :param use: Parameters from the set; those given beside it come first. Default: none.
    :param b: inertance (kg or kg·m², > 0).
    :param axis: local axis (U1, U2, U3, R1, R2, R3, default U1). One of U1, U2, U3, R1, R2, R3.
    :param axis1: Direction of local axis 1. Default: from the first node to the second; +Z for one node.
    :param axis2: Vector in the plane of local axes 1 and 2. Default: the upward direction square to axis 1; +X
        for a vertical one.
    """

    _name = "Inerter"
    _words = frozenset({"axis"})

    def __init__(
        self,
        *,
        nodes: Any | None = None,
        node: str | None = None,
        use: Any | None = None,
        b: Quantity | None = None,
        axis: Name | None = None,
        axis1: Any | None = None,
        axis2: Any | None = None,
    ) -> None:
        super().__init__(
            nodes=nodes,
            node=node,
            use=use,
            b=b,
            axis=axis,
            axis1=axis1,
            axis2=axis2,
        )


class Jennings(Block):
    """A parabolic rise, a strong phase, an exponential decay.

    :param rise: Time of the rise.
    :param strong: Time of the strong phase.
    :param decay: Rate of the decay.
    """

    _name = "Jennings"

    def __init__(
        self,
        *,
        rise: Quantity | None = None,
        strong: Quantity | None = None,
        decay: Quantity | None = None,
    ) -> None:
        super().__init__(
            rise=rise,
            strong=strong,
            decay=decay,
        )


class Largest(Block):
    """Largest of other outputs.

    :param terms: The outputs, each at the same time.
    :param hidden: Other outputs are made from it, and it is left out of files, report and summary. Default:
        `false`.
    """

    _name = "Largest"

    def __init__(
        self,
        *,
        terms: Sequence[Any] | None = None,
        hidden: bool | str | None = None,
    ) -> None:
        super().__init__(
            terms=terms,
            hidden=hidden,
        )


class LeadRubber(Block):
    """Lead-rubber bearing whose core softens as it heats up. On two nodes, or one and the ground.

    :param nodes: The nodes. Default: `node`.
    :param node: The only node: a link or spring between it and the ground. Default: `nodes`.
    :param use: Parameters from the set; those given beside it come first. Default: none.
    :param kr: shear stiffness of the rubber, its modulus · area/thickness (N/m, ≥ 0).
    :param lead_diameter: diameter of the core (m, > 0).
    :param lead_height: height of the core, rubber and shims (m, > 0).
    :param lead_strength: yield stress of the cold core (N/m², > 0, default 10000000).
    :param yield_displacement: displacement at which the core yields (m, > 0).
    :param shim_thickness: thickness of all steel shims together (m, ≥ 0, default 0).
    :param heating: the core heats up (true, false, default true).
    :param kv: axial stiffness, both ways (N/m, ≥ 0, default 0).
    :param softening: loss of strength with temperature, per K (–, > 0, default 0.0069).
    :param lead_density: density of lead (kg/m³, > 0, default 11200).
    :param lead_heat: specific heat of lead, J/(kg K) (m^2·s^-2, > 0, default 130).
    :param steel_conductivity: thermal conductivity of steel, W/(m K) (kg·m·s^-3, ≥ 0, default 50).
    :param steel_diffusivity: thermal diffusivity of steel (m^2·s^-1, > 0, default 0.0000141).
    :param coupling: how unloading is told: axis by axis, or by the direction of the motion (Axes, Direction,
        default Axes). One of Axes, Direction.
    :param beta: shape: loading against β + γ, return with γ − β (–, > 0, default 0.5).
    :param gamma: shape, −β < γ ≤ β; at γ = β the return is elastic (–, any, default 0.5).
    :param eta: sharpness of yielding (–, between 1 and 20, default 2).
    :param axis1: Direction of local axis 1. Default: from the first node to the second; +Z for one node.
    :param axis2: Vector in the plane of local axes 1 and 2. Default: the upward direction square to axis 1; +X
        for a vertical one.
    :param effective_stiffness: Stiffness that stands for the link in the linear structure (K effective of FNA).
        The link equations take it out again. Default: 0; the basis is made with a thousandth of the stiffness of
        the closed link.
    :param p_delta_at: Where the moment of the axial force over the shear of the link acts (P-Δ): its share at
        either end, the ground as the first for one node; the rest is a couple of shears, for which the nodes must
        be apart. `(1, 0)` for a bearing whose dish lies below. For laws with U1 and U2 or U3. With `p_delta` or
        without. Default: no such moment.
    :param shear_at: Distance from the second node at which the shear of a link with two nodes acts. Default: `0`.
    """

    _name = "LeadRubber"
    _words = frozenset({"coupling"})

    def __init__(
        self,
        *,
        nodes: Any | None = None,
        node: str | None = None,
        use: Any | None = None,
        kr: Quantity | None = None,
        lead_diameter: Quantity | None = None,
        lead_height: Quantity | None = None,
        lead_strength: Quantity | None = None,
        yield_displacement: Quantity | None = None,
        shim_thickness: Quantity | None = None,
        heating: bool | str | None = None,
        kv: Quantity | None = None,
        softening: Quantity | None = None,
        lead_density: Quantity | None = None,
        lead_heat: Quantity | None = None,
        steel_conductivity: Quantity | None = None,
        steel_diffusivity: Quantity | None = None,
        coupling: Name | None = None,
        beta: Quantity | None = None,
        gamma: Quantity | None = None,
        eta: Quantity | None = None,
        axis1: Any | None = None,
        axis2: Any | None = None,
        effective_stiffness: Any | None = None,
        p_delta_at: Any | None = None,
        shear_at: Quantity | None = None,
    ) -> None:
        super().__init__(
            nodes=nodes,
            node=node,
            use=use,
            kr=kr,
            lead_diameter=lead_diameter,
            lead_height=lead_height,
            lead_strength=lead_strength,
            yield_displacement=yield_displacement,
            shim_thickness=shim_thickness,
            heating=heating,
            kv=kv,
            softening=softening,
            lead_density=lead_density,
            lead_heat=lead_heat,
            steel_conductivity=steel_conductivity,
            steel_diffusivity=steel_diffusivity,
            coupling=coupling,
            beta=beta,
            gamma=gamma,
            eta=eta,
            axis1=axis1,
            axis2=axis2,
            effective_stiffness=effective_stiffness,
            p_delta_at=p_delta_at,
            shear_at=shear_at,
        )


class Linear(Block):
    """A straight line. Straight lines between samples.

    :param dt: The new step.
    """

    _name = "Linear"

    def __init__(
        self,
        *,
        dt: Quantity | None = None,
    ) -> None:
        super().__init__(
            dt=dt,
        )


class LinearAdd(Block):
    """Largest values added, and smallest values. For static cases that is their sum; of motions it is beyond what
    happens at one time.

    :param cases: Cases, and combinations that stand before, with their factors; names in a list have the factor
        1.
    """

    _name = "LinearAdd"

    def __init__(
        self,
        *,
        cases: Any | None = None,
    ) -> None:
        super().__init__(
            cases=cases,
        )


class LinearLink(Block):
    """Coupled stiffness and damping that may be unsymmetric, as of seals and bearings. On two nodes, or one and the
    ground.

    :param nodes: The nodes. Default: `node`.
    :param node: The only node: a link or spring between it and the ground. Default: `nodes`.
    :param use: Parameters from the set; those given beside it come first. Default: none.
    :param stiffness: 6 × 6 matrix in local axes, by rows (N/m, 6 × 6, default absent).
    :param damping: 6 × 6 matrix in local axes, by rows (N·s/m, 6 × 6, default absent).
    :param axis1: Direction of local axis 1. Default: from the first node to the second; +Z for one node.
    :param axis2: Vector in the plane of local axes 1 and 2. Default: the upward direction square to axis 1; +X
        for a vertical one.
    :param effective_stiffness: Stiffness that stands for the link in the linear structure (K effective of FNA).
        The link equations take it out again. Default: 0; the basis is made with a thousandth of the stiffness of
        the closed link.
    :param p_delta_at: Where the moment of the axial force over the shear of the link acts (P-Δ): its share at
        either end, the ground as the first for one node; the rest is a couple of shears, for which the nodes must
        be apart. `(1, 0)` for a bearing whose dish lies below. For laws with U1 and U2 or U3. With `p_delta` or
        without. Default: no such moment.
    :param shear_at: Distance from the second node at which the shear of a link with two nodes acts. Default: `0`.
    """

    _name = "LinearLink"

    def __init__(
        self,
        *,
        nodes: Any | None = None,
        node: str | None = None,
        use: Any | None = None,
        stiffness: Sequence[Any] | None = None,
        damping: Sequence[Any] | None = None,
        axis1: Any | None = None,
        axis2: Any | None = None,
        effective_stiffness: Any | None = None,
        p_delta_at: Any | None = None,
        shear_at: Quantity | None = None,
    ) -> None:
        super().__init__(
            nodes=nodes,
            node=node,
            use=use,
            stiffness=stiffness,
            damping=damping,
            axis1=axis1,
            axis2=axis2,
            effective_stiffness=effective_stiffness,
            p_delta_at=p_delta_at,
            shear_at=shear_at,
        )


class LinkDeformation(Block):
    """Deformation of a link.

    :param link: The link.
    :param axis: Local axis of a link between two nodes or a node and the ground. One of U1, U2, U3, R1, R2, R3.
        Default: `coordinate`.
    :param coordinate: Coordinate of the law, from 0. Default: `axis`.
    :param factor: Factor, with or without unit. Default: `1`.
    :param hidden: Other outputs are made from it, and it is left out of files, report and summary. Default:
        `false`.
    """

    _name = "LinkDeformation"
    _words = frozenset({"axis"})

    def __init__(
        self,
        *,
        link: str | None = None,
        axis: Name | None = None,
        coordinate: int | str | None = None,
        factor: Quantity | None = None,
        hidden: bool | str | None = None,
    ) -> None:
        super().__init__(
            link=link,
            axis=axis,
            coordinate=coordinate,
            factor=factor,
            hidden=hidden,
        )


class LinkForce(Block):
    """Force or moment of a link.

    :param link: The link.
    :param axis: Local axis of a link between two nodes or a node and the ground. One of U1, U2, U3, R1, R2, R3.
        Default: `coordinate`.
    :param coordinate: Coordinate of the law, from 0. Default: `axis`.
    :param factor: Factor, with or without unit. Default: `1`.
    :param hidden: Other outputs are made from it, and it is left out of files, report and summary. Default:
        `false`.
    """

    _name = "LinkForce"
    _words = frozenset({"axis"})

    def __init__(
        self,
        *,
        link: str | None = None,
        axis: Name | None = None,
        coordinate: int | str | None = None,
        factor: Quantity | None = None,
        hidden: bool | str | None = None,
    ) -> None:
        super().__init__(
            link=link,
            axis=axis,
            coordinate=coordinate,
            factor=factor,
            hidden=hidden,
        )


class LinkHistory(Block):
    """A history variable of a link, such as its plastic slip.

    :param link: The link.
    :param variable: The variable.
    :param hidden: Other outputs are made from it, and it is left out of files, report and summary. Default:
        `false`.
    """

    _name = "LinkHistory"

    def __init__(
        self,
        *,
        link: str | None = None,
        variable: Any | None = None,
        hidden: bool | str | None = None,
    ) -> None:
        super().__init__(
            link=link,
            variable=variable,
            hidden=hidden,
        )


class Mass(Block):
    """Point mass and rotary inertia at a node. On one node.

    :param nodes: The nodes. Default: `node`.
    :param node: The only node: a link or spring between it and the ground. Default: `nodes`.
    :param use: Parameters from the set; those given beside it come first. Default: none.
    :param mass: mass, the same in all directions (kg, ≥ 0, default absent).
    :param masses: instead of `mass`: masses along X, Y, Z (kg, 3 numbers, ≥ 0, default absent).
    :param inertia: moments of inertia about X, Y, Z (kg·m², 3 numbers, ≥ 0, default absent).
    :param products: off-diagonal entries of the inertia matrix, Pxy = −∫xy dm (kg·m², 3 numbers, any, default
        absent).
    :param inertia_local: inertia is about local 1, 2, 3 instead of X, Y, Z (true, false, default false).
    :param axis1: Direction of local axis 1. Default: from the first node to the second; +Z for one node.
    :param axis2: Vector in the plane of local axes 1 and 2. Default: the upward direction square to axis 1; +X
        for a vertical one.
    """

    _name = "Mass"

    def __init__(
        self,
        *,
        nodes: Any | None = None,
        node: str | None = None,
        use: Any | None = None,
        mass: Quantity | None = None,
        masses: Quantity | Sequence[Any] | None = None,
        inertia: Quantity | Sequence[Any] | None = None,
        products: Quantity | Sequence[Any] | None = None,
        inertia_local: bool | str | None = None,
        axis1: Any | None = None,
        axis2: Any | None = None,
    ) -> None:
        super().__init__(
            nodes=nodes,
            node=node,
            use=use,
            mass=mass,
            masses=masses,
            inertia=inertia,
            products=products,
            inertia_local=inertia_local,
            axis1=axis1,
            axis2=axis2,
        )


class MaxwellDamper(Block):
    """Spring in series with a dashpot of a power of the rate. On two nodes, or one and the ground.

    :param nodes: The nodes. Default: `node`.
    :param node: The only node: a link or spring between it and the ground. Default: `nodes`.
    :param use: Parameters from the set; those given beside it come first. Default: none.
    :param k: stiffness of the spring (N/m, > 0).
    :param c: coefficient of the dashpot (N/(m/s)^exponent, > 0).
    :param exponent: exponent of the rate (–, between 0.1 and 2, default 1).
    :param axis: local axis (U1, U2, U3, default U1). One of U1, U2, U3.
    :param axis1: Direction of local axis 1. Default: from the first node to the second; +Z for one node.
    :param axis2: Vector in the plane of local axes 1 and 2. Default: the upward direction square to axis 1; +X
        for a vertical one.
    :param effective_stiffness: Stiffness that stands for the link in the linear structure (K effective of FNA).
        The link equations take it out again. Default: 0; the basis is made with a thousandth of the stiffness of
        the closed link.
    :param p_delta_at: Where the moment of the axial force over the shear of the link acts (P-Δ): its share at
        either end, the ground as the first for one node; the rest is a couple of shears, for which the nodes must
        be apart. `(1, 0)` for a bearing whose dish lies below. For laws with U1 and U2 or U3. With `p_delta` or
        without. Default: no such moment.
    :param shear_at: Distance from the second node at which the shear of a link with two nodes acts. Default: `0`.
    """

    _name = "MaxwellDamper"
    _words = frozenset({"axis"})

    def __init__(
        self,
        *,
        nodes: Any | None = None,
        node: str | None = None,
        use: Any | None = None,
        k: Quantity | None = None,
        c: Quantity | None = None,
        exponent: Quantity | None = None,
        axis: Name | None = None,
        axis1: Any | None = None,
        axis2: Any | None = None,
        effective_stiffness: Any | None = None,
        p_delta_at: Any | None = None,
        shear_at: Quantity | None = None,
    ) -> None:
        super().__init__(
            nodes=nodes,
            node=node,
            use=use,
            k=k,
            c=c,
            exponent=exponent,
            axis=axis,
            axis1=axis1,
            axis2=axis2,
            effective_stiffness=effective_stiffness,
            p_delta_at=p_delta_at,
            shear_at=shear_at,
        )


class Mean(Block):
    """Its mean."""

    _name = "Mean"


class MemberForce(Block):
    """A force inside a beam or truss in its local axes, with the loads along it: axial force N (tension positive),
    shear V2 and V3, torsion T, moments M2 and M3 (positive where they press on the side of positive local 3 and
    2). A mass matrix that is `Lumped` brings inertia to the nodes; that of a `Consistent` one between them is
    left out.

    :param element: The beam or truss.
    :param force: Which force. One of N, V2, V3, T, M2, M3.
    :param at: Where; at a point load, just before it.
    :param factor: Factor, with or without unit. Default: `1`.
    :param hidden: Other outputs are made from it, and it is left out of files, report and summary. Default:
        `false`.
    """

    _name = "MemberForce"
    _words = frozenset({"force"})

    def __init__(
        self,
        *,
        element: str | None = None,
        force: Name | None = None,
        at: Any | None = None,
        factor: Quantity | None = None,
        hidden: bool | str | None = None,
    ) -> None:
        super().__init__(
            element=element,
            force=force,
            at=at,
            factor=factor,
            hidden=hidden,
        )


class Modal(Block):
    """The same ratio of critical damping in all modes of the structure without link stiffness.

    :param ratio: Share of critical damping.
    """

    _name = "Modal"

    def __init__(
        self,
        *,
        ratio: Quantity | None = None,
    ) -> None:
        super().__init__(
            ratio=ratio,
        )


class ModalTable(Block):
    """Ratio by frequency, linear between points and constant beyond them.

    :param points: The ratios.
    """

    _name = "ModalTable"

    def __init__(
        self,
        *,
        points: Any | None = None,
    ) -> None:
        super().__init__(
            points=points,
        )


class MultilinearElastic(Block):
    """Elastic spring whose force follows a curve through points. On two nodes, or one and the ground.

    :param nodes: The nodes. Default: `node`.
    :param node: The only node: a link or spring between it and the ground. Default: `nodes`.
    :param use: Parameters from the set; those given beside it come first. Default: none.
    :param deformation: deformations of the points, ascending (m or –, list, any).
    :param force: forces of the points, none against its deformation (N or N·m, list, any).
    :param axis: local axis (U1, U2, U3, R1, R2, R3, default U1). One of U1, U2, U3, R1, R2, R3.
    :param axis1: Direction of local axis 1. Default: from the first node to the second; +Z for one node.
    :param axis2: Vector in the plane of local axes 1 and 2. Default: the upward direction square to axis 1; +X
        for a vertical one.
    :param effective_stiffness: Stiffness that stands for the link in the linear structure (K effective of FNA).
        The link equations take it out again. Default: 0; the basis is made with a thousandth of the stiffness of
        the closed link.
    :param p_delta_at: Where the moment of the axial force over the shear of the link acts (P-Δ): its share at
        either end, the ground as the first for one node; the rest is a couple of shears, for which the nodes must
        be apart. `(1, 0)` for a bearing whose dish lies below. For laws with U1 and U2 or U3. With `p_delta` or
        without. Default: no such moment.
    :param shear_at: Distance from the second node at which the shear of a link with two nodes acts. Default: `0`.
    """

    _name = "MultilinearElastic"
    _words = frozenset({"axis"})

    def __init__(
        self,
        *,
        nodes: Any | None = None,
        node: str | None = None,
        use: Any | None = None,
        deformation: Quantity | Sequence[Any] | None = None,
        force: Quantity | Sequence[Any] | None = None,
        axis: Name | None = None,
        axis1: Any | None = None,
        axis2: Any | None = None,
        effective_stiffness: Any | None = None,
        p_delta_at: Any | None = None,
        shear_at: Quantity | None = None,
    ) -> None:
        super().__init__(
            nodes=nodes,
            node=node,
            use=use,
            deformation=deformation,
            force=force,
            axis=axis,
            axis1=axis1,
            axis2=axis2,
            effective_stiffness=effective_stiffness,
            p_delta_at=p_delta_at,
            shear_at=shear_at,
        )


class MultilinearPlastic(Block):
    """Plastic spring along a curve through points: kinematic, Iwan, isotropic, Takeda or pivot. On two nodes, or one
    and the ground.

    :param nodes: The nodes. Default: `node`.
    :param node: The only node: a link or spring between it and the ground. Default: `nodes`.
    :param use: Parameters from the set; those given beside it come first. Default: none.
    :param deformation: deformations of the points, ascending (m or –, list, any).
    :param force: forces of the points, none against its deformation (N or N·m, list, any).
    :param rule: hysteresis; `Kinematic` is CSI's, also where the sides differ (Kinematic, Iwan, Isotropic,
        Takeda, Pivot, default Kinematic). One of Kinematic, Iwan, Isotropic, Takeda, Pivot.
    :param alpha1: Pivot: unloading from positive force goes towards −α₁ f_y (10) (–, > 0, default absent).
    :param alpha2: Pivot: the same from negative force (α₁) (–, > 0, default absent).
    :param beta1: Pivot: loading to positive force goes through β₁ f_y (0.7) (–, between 0 and 1, default absent).
    :param beta2: Pivot: the same to negative force (β₁) (–, between 0 and 1, default absent).
    :param axis: local axis (U1, U2, U3, R1, R2, R3, default U1). One of U1, U2, U3, R1, R2, R3.
    :param axis1: Direction of local axis 1. Default: from the first node to the second; +Z for one node.
    :param axis2: Vector in the plane of local axes 1 and 2. Default: the upward direction square to axis 1; +X
        for a vertical one.
    :param effective_stiffness: Stiffness that stands for the link in the linear structure (K effective of FNA).
        The link equations take it out again. Default: 0; the basis is made with a thousandth of the stiffness of
        the closed link.
    :param p_delta_at: Where the moment of the axial force over the shear of the link acts (P-Δ): its share at
        either end, the ground as the first for one node; the rest is a couple of shears, for which the nodes must
        be apart. `(1, 0)` for a bearing whose dish lies below. For laws with U1 and U2 or U3. With `p_delta` or
        without. Default: no such moment.
    :param shear_at: Distance from the second node at which the shear of a link with two nodes acts. Default: `0`.
    """

    _name = "MultilinearPlastic"
    _words = frozenset({"axis", "rule"})

    def __init__(
        self,
        *,
        nodes: Any | None = None,
        node: str | None = None,
        use: Any | None = None,
        deformation: Quantity | Sequence[Any] | None = None,
        force: Quantity | Sequence[Any] | None = None,
        rule: Name | None = None,
        alpha1: Quantity | None = None,
        alpha2: Quantity | None = None,
        beta1: Quantity | None = None,
        beta2: Quantity | None = None,
        axis: Name | None = None,
        axis1: Any | None = None,
        axis2: Any | None = None,
        effective_stiffness: Any | None = None,
        p_delta_at: Any | None = None,
        shear_at: Quantity | None = None,
    ) -> None:
        super().__init__(
            nodes=nodes,
            node=node,
            use=use,
            deformation=deformation,
            force=force,
            rule=rule,
            alpha1=alpha1,
            alpha2=alpha2,
            beta1=beta1,
            beta2=beta2,
            axis=axis,
            axis1=axis1,
            axis2=axis2,
            effective_stiffness=effective_stiffness,
            p_delta_at=p_delta_at,
            shear_at=shear_at,
        )


class NLink(Block):
    """Contact: gap with dashpot along local 1, coupled friction along local 2 and 3. On two nodes, or one and the
    ground.

    :param nodes: The nodes. Default: `node`.
    :param node: The only node: a link or spring between it and the ground. Default: `nodes`.
    :param use: Parameters from the set; those given beside it come first. Default: none.
    :param kn: contact stiffness (N/m, > 0).
    :param opening: clearance at rest (negative: interference) (m, any, default 0).
    :param damping: contact dashpot, acts only while closed (N·s/m, ≥ 0, default 0).
    :param restitution: instead of `damping`: speed after over speed before an impact (–, > 0 and ≤ 1, default
        absent).
    :param impact_mass: mass that strikes, for `restitution`; none: worked out from the structure (kg, > 0,
        default absent).
    :param pull: the dashpot may pull while the gap is closed (true, false, default false).
    :param mu: friction coefficient; none: no friction (–, ≥ 0, default absent).
    :param mu_slow: instead of `mu`: friction coefficient at rest (–, ≥ 0, default absent).
    :param mu_fast: instead of `mu`: friction coefficient at speed (–, ≥ 0, default absent).
    :param rate: rate at which μ goes from slow to fast (s/m, ≥ 0, default absent).
    :param mu_static: friction coefficient before it breaks away; none: that of slow slip (–, ≥ 0, default
        absent).
    :param static_slip: slip over which `mu_static` is gone; 0: as soon as the spring `ks` can follow (m, ≥ 0,
        default 0).
    :param ks: pre-slip stiffness; required with friction (N/m, > 0, default absent).
    :param cs: dashpot beside the spring `ks`: damps a contact that sticks (N·s/m, ≥ 0, default 0).
    :param k_post: post-slip stiffness, less than `ks` (N/m, ≥ 0, default 0).
    :param radius: radius of a pendulum surface; 0 is flat (m, ≥ 0, default 0).
    :param r1: linear rotational spring, open or closed (N·m, ≥ 0, default 0).
    :param r2: linear rotational spring, open or closed (N·m, ≥ 0, default 0).
    :param r3: linear rotational spring, open or closed (N·m, ≥ 0, default 0).
    :param axis1: Direction of local axis 1. Default: from the first node to the second; +Z for one node.
    :param axis2: Vector in the plane of local axes 1 and 2. Default: the upward direction square to axis 1; +X
        for a vertical one.
    :param effective_stiffness: Stiffness that stands for the link in the linear structure (K effective of FNA).
        The link equations take it out again. Default: 0; the basis is made with a thousandth of the stiffness of
        the closed link.
    :param p_delta_at: Where the moment of the axial force over the shear of the link acts (P-Δ): its share at
        either end, the ground as the first for one node; the rest is a couple of shears, for which the nodes must
        be apart. `(1, 0)` for a bearing whose dish lies below. For laws with U1 and U2 or U3. With `p_delta` or
        without. Default: no such moment.
    :param shear_at: Distance from the second node at which the shear of a link with two nodes acts. Default: `0`.
    """

    _name = "NLink"

    def __init__(
        self,
        *,
        nodes: Any | None = None,
        node: str | None = None,
        use: Any | None = None,
        kn: Quantity | None = None,
        opening: Quantity | None = None,
        damping: Quantity | None = None,
        restitution: Quantity | None = None,
        impact_mass: Quantity | None = None,
        pull: bool | str | None = None,
        mu: Quantity | None = None,
        mu_slow: Quantity | None = None,
        mu_fast: Quantity | None = None,
        rate: Quantity | None = None,
        mu_static: Quantity | None = None,
        static_slip: Quantity | None = None,
        ks: Quantity | None = None,
        cs: Quantity | None = None,
        k_post: Quantity | None = None,
        radius: Quantity | None = None,
        r1: Quantity | None = None,
        r2: Quantity | None = None,
        r3: Quantity | None = None,
        axis1: Any | None = None,
        axis2: Any | None = None,
        effective_stiffness: Any | None = None,
        p_delta_at: Any | None = None,
        shear_at: Quantity | None = None,
    ) -> None:
        super().__init__(
            nodes=nodes,
            node=node,
            use=use,
            kn=kn,
            opening=opening,
            damping=damping,
            restitution=restitution,
            impact_mass=impact_mass,
            pull=pull,
            mu=mu,
            mu_slow=mu_slow,
            mu_fast=mu_fast,
            rate=rate,
            mu_static=mu_static,
            static_slip=static_slip,
            ks=ks,
            cs=cs,
            k_post=k_post,
            radius=radius,
            r1=r1,
            r2=r2,
            r3=r3,
            axis1=axis1,
            axis2=axis2,
            effective_stiffness=effective_stiffness,
            p_delta_at=p_delta_at,
            shear_at=shear_at,
        )


class Norm(Block):
    """Root of the sum of the squares of other outputs.

    :param terms: The outputs, each at the same time.
    :param hidden: Other outputs are made from it, and it is left out of files, report and summary. Default:
        `false`.
    """

    _name = "Norm"

    def __init__(
        self,
        *,
        terms: Sequence[Any] | None = None,
        hidden: bool | str | None = None,
    ) -> None:
        super().__init__(
            terms=terms,
            hidden=hidden,
        )


class Overturning(Block):
    """Moment about a point of what the structure passes to its supports and to the ground; positive as of a force
    along `direction` above that point. Weights take part, and so does what an `EqualDof` passes on between nodes
    at different heights.

    :param direction: Direction in which it overturns. One of X, Y.
    :param about: The point; a height is that of a point at x = y = 0.
    :param hidden: Other outputs are made from it, and it is left out of files, report and summary. Default:
        `false`.
    """

    _name = "Overturning"
    _words = frozenset({"direction"})

    def __init__(
        self,
        *,
        direction: Name | None = None,
        about: Any | None = None,
        hidden: bool | str | None = None,
    ) -> None:
        super().__init__(
            direction=direction,
            about=about,
            hidden=hidden,
        )


class PMMHinge(Block):
    """Plastic hinge with interaction of axial force and both moments (P-M2-M3), by return mapping. On two nodes, or
    one and the ground.

    :param nodes: The nodes. Default: `node`.
    :param node: The only node: a link or spring between it and the ground. Default: `nodes`.
    :param use: Parameters from the set; those given beside it come first. Default: none.
    :param axial: elastic, along U1 (N/m, > 0).
    :param bending2: elastic, about R2 (N·m, > 0).
    :param bending3: elastic, about R3 (N·m, > 0).
    :param py: axial strength without moments (N, > 0).
    :param mp2: strength about R2 alone (N·m, > 0).
    :param mp3: strength about R3 alone (N·m, > 0).
    :param exponent_p: exponent of the axial force (–, between 1.2 and 8, default 2).
    :param exponent_m2: exponent of the moment about R2 (–, between 1.2 and 8, default 2).
    :param exponent_m3: exponent of the moment about R3 (–, between 1.2 and 8, default 2).
    :param ratio: stiffness after yielding over elastic stiffness, below 1 (–, between 0 and 1, default 0).
    :param axis1: Direction of local axis 1. Default: from the first node to the second; +Z for one node.
    :param axis2: Vector in the plane of local axes 1 and 2. Default: the upward direction square to axis 1; +X
        for a vertical one.
    :param effective_stiffness: Stiffness that stands for the link in the linear structure (K effective of FNA).
        The link equations take it out again. Default: 0; the basis is made with a thousandth of the stiffness of
        the closed link.
    :param p_delta_at: Where the moment of the axial force over the shear of the link acts (P-Δ): its share at
        either end, the ground as the first for one node; the rest is a couple of shears, for which the nodes must
        be apart. `(1, 0)` for a bearing whose dish lies below. For laws with U1 and U2 or U3. With `p_delta` or
        without. Default: no such moment.
    :param shear_at: Distance from the second node at which the shear of a link with two nodes acts. Default: `0`.
    """

    _name = "PMMHinge"

    def __init__(
        self,
        *,
        nodes: Any | None = None,
        node: str | None = None,
        use: Any | None = None,
        axial: Quantity | None = None,
        bending2: Quantity | None = None,
        bending3: Quantity | None = None,
        py: Quantity | None = None,
        mp2: Quantity | None = None,
        mp3: Quantity | None = None,
        exponent_p: Quantity | None = None,
        exponent_m2: Quantity | None = None,
        exponent_m3: Quantity | None = None,
        ratio: Quantity | None = None,
        axis1: Any | None = None,
        axis2: Any | None = None,
        effective_stiffness: Any | None = None,
        p_delta_at: Any | None = None,
        shear_at: Quantity | None = None,
    ) -> None:
        super().__init__(
            nodes=nodes,
            node=node,
            use=use,
            axial=axial,
            bending2=bending2,
            bending3=bending3,
            py=py,
            mp2=mp2,
            mp3=mp3,
            exponent_p=exponent_p,
            exponent_m2=exponent_m2,
            exponent_m3=exponent_m3,
            ratio=ratio,
            axis1=axis1,
            axis2=axis2,
            effective_stiffness=effective_stiffness,
            p_delta_at=p_delta_at,
            shear_at=shear_at,
        )


class Pipe(Block):
    """A round pipe.

    :param diameter: Outer diameter.
    :param thickness: Of the wall; at most half the diameter.
    """

    _name = "Pipe"

    def __init__(
        self,
        *,
        diameter: Quantity | None = None,
        thickness: Quantity | None = None,
    ) -> None:
        super().__init__(
            diameter=diameter,
            thickness=thickness,
        )


class Point(Block):
    """A force or moment at a place of a member.

    :param element: The beam or truss, or a group of them: each.
    :param at: Where.
    :param dof: Global direction. One of Ux, Uy, Uz, Rx, Ry, Rz. Default: `axis`.
    :param axis: Local axis instead. One of U1, U2, U3, R1, R2, R3. Default: `dof`.
    :param force: Force. Default: for a rotation.
    :param moment: Moment. Default: for a translation.
    """

    _name = "Point"
    _words = frozenset({"axis", "dof"})

    def __init__(
        self,
        *,
        element: str | None = None,
        at: Any | None = None,
        dof: Name | None = None,
        axis: Name | None = None,
        force: Quantity | None = None,
        moment: Quantity | None = None,
    ) -> None:
        super().__init__(
            element=element,
            at=at,
            dof=dof,
            axis=axis,
            force=force,
            moment=moment,
        )


class Points(Block):
    """Samples given in the model file.

    :param points: The samples.
    :param interpolation: Between samples: straight lines, or a natural cubic spline. One of Linear, Cubic.
        Default: `Linear`.
    :param after_end: After the last sample: no case may last longer, zero, or the last value. One of Error, Zero,
        Hold. Default: `Error`.
    """

    _name = "Points"
    _words = frozenset({"after_end", "interpolation"})

    def __init__(
        self,
        *,
        points: Any | None = None,
        interpolation: Name | None = None,
        after_end: Name | None = None,
    ) -> None:
        super().__init__(
            points=points,
            interpolation=interpolation,
            after_end=after_end,
        )


class Polynomial(Block):
    """A polynomial.

    :param order: Its order, 20 at most.
    """

    _name = "Polynomial"

    def __init__(
        self,
        *,
        order: int | str | None = None,
    ) -> None:
        super().__init__(
            order=order,
        )


class Ramp(Block):
    """A straight rise, then constant.

    :param amplitude: Largest value; its unit is the unit of the function.
    :param start: Time at which it begins; zero before. Default: `0`.
    :param rise: Time of the rise.
    """

    _name = "Ramp"

    def __init__(
        self,
        *,
        amplitude: Quantity | None = None,
        start: Quantity | None = None,
        rise: Quantity | None = None,
    ) -> None:
        super().__init__(
            amplitude=amplitude,
            start=start,
            rise=rise,
        )


class Rayleigh(Block):
    """C = mass · M + stiffness · K, with K of the structure without links.

    :param mass: Factor of the mass matrix. Default: `0`.
    :param stiffness: Factor of the stiffness matrix. Default: `0`.
    """

    _name = "Rayleigh"

    def __init__(
        self,
        *,
        mass: Quantity | None = None,
        stiffness: Quantity | None = None,
    ) -> None:
        super().__init__(
            mass=mass,
            stiffness=stiffness,
        )


class RayleighAt(Block):
    """Rayleigh damping with the same ratio at two frequencies.

    :param ratio: Share of critical damping at both frequencies.
    :param f1: First frequency.
    :param f2: Second frequency.
    """

    _name = "RayleighAt"

    def __init__(
        self,
        *,
        ratio: Quantity | None = None,
        f1: Quantity | None = None,
        f2: Quantity | None = None,
    ) -> None:
        super().__init__(
            ratio=ratio,
            f1=f1,
            f2=f2,
        )


class Reaction(Block):
    """Force or moment of supports on the structure, in sum: of the elements and links at a direction that they fix.
    Weight, inertia and damping by the mass of that direction itself go past the structure and are not in it.

    :param node: The node, a group of nodes or a list of nodes.
    :param dof: Direction, along which supports fix all of them. One of Ux, Uy, Uz, Rx, Ry, Rz.
    :param factor: Factor, with or without unit. Default: `1`.
    :param hidden: Other outputs are made from it, and it is left out of files, report and summary. Default:
        `false`.
    """

    _name = "Reaction"
    _words = frozenset({"dof"})

    def __init__(
        self,
        *,
        node: str | None = None,
        dof: Name | None = None,
        factor: Quantity | None = None,
        hidden: bool | str | None = None,
    ) -> None:
        super().__init__(
            node=node,
            dof=dof,
            factor=factor,
            hidden=hidden,
        )


class Record(Block):
    """An accelerogram in any of the known formats, processed in the order of the fields from `trim` to `scale`.

    :param file: The file.
    :param component: Component of a file with several. Default: the only one.
    :param format: Format. One of AT2, COSMOS, CSMIP, KNET, ESM, Columns. Default: told from the file.
    :param unit: Unit of the samples. Default: for files that say it.
    :param dt: Time step. Default: as the file says.
    :param trim: Part that is kept. Default: none.
    :param baseline: Baseline correction. Default: none.
    :param taper: Share of the record that is faded in and out. Default: `0`.
    :param filter: Filter. Default: none.
    :param resample: Another time step. Default: none.
    :param scale_to: Peak to which it is scaled. Default: none.
    :param scale: Factor. Default: `1`.
    :param start: Time of the first sample. Default: `0`.
    :param after_end: After the last sample: no case may last longer, zero, or the last value. One of Error, Zero,
        Hold. Default: `Zero`.
    """

    _name = "Record"
    _words = frozenset({"after_end", "baseline", "filter", "format", "resample"})

    def __init__(
        self,
        *,
        file: Any | None = None,
        component: Any | None = None,
        format: Name | None = None,
        unit: str | None = None,
        dt: Quantity | None = None,
        trim: Any | None = None,
        baseline: Name | Block | Mapping[str, Any] | None = None,
        taper: Quantity | None = None,
        filter: Name | Block | Mapping[str, Any] | None = None,
        resample: Name | Block | Mapping[str, Any] | None = None,
        scale_to: Quantity | None = None,
        scale: Quantity | None = None,
        start: Quantity | None = None,
        after_end: Name | None = None,
    ) -> None:
        super().__init__(
            file=file,
            component=component,
            format=format,
            unit=unit,
            dt=dt,
            trim=trim,
            baseline=baseline,
            taper=taper,
            filter=filter,
            resample=resample,
            scale_to=scale_to,
            scale=scale,
            start=start,
            after_end=after_end,
        )


class Rectangle(Block):
    """A solid rectangle.

    :param width: Along local 3.
    :param depth: Along local 2.
    """

    _name = "Rectangle"

    def __init__(
        self,
        *,
        width: Quantity | None = None,
        depth: Quantity | None = None,
    ) -> None:
        super().__init__(
            width=width,
            depth=depth,
        )


class Rest(Block):
    """What leaves the ground at rest at the end."""

    _name = "Rest"


class Ricker(Block):
    """Ricker wavelet: amplitude · (1 − 2a) e^(−a), a = (π frequency (t − center))².

    :param amplitude: Largest value; its unit is the unit of the function.
    :param frequency: Cycles per second.
    :param center: Time of the peak. Default: `0`.
    """

    _name = "Ricker"

    def __init__(
        self,
        *,
        amplitude: Quantity | None = None,
        frequency: Quantity | None = None,
        center: Quantity | None = None,
    ) -> None:
        super().__init__(
            amplitude=amplitude,
            frequency=frequency,
            center=center,
        )


class RigidBody(Block):
    """Nodes that move as one rigid body; the first leads, the others follow. On 2 nodes or more.

    :param nodes: The nodes. Default: `node`.
    :param node: The only node: a link or spring between it and the ground. Default: `nodes`.
    :param use: Parameters from the set; those given beside it come first. Default: none.
    :param corners: corners of the body from its first node, in order; only drawn (m, list of (x, y, z), default
        absent).
    :param axis1: Direction of local axis 1. Default: from the first node to the second; +Z for one node.
    :param axis2: Vector in the plane of local axes 1 and 2. Default: the upward direction square to axis 1; +X
        for a vertical one.
    """

    _name = "RigidBody"

    def __init__(
        self,
        *,
        nodes: Any | None = None,
        node: str | None = None,
        use: Any | None = None,
        corners: Sequence[Any] | None = None,
        axis1: Any | None = None,
        axis2: Any | None = None,
    ) -> None:
        super().__init__(
            nodes=nodes,
            node=node,
            use=use,
            corners=corners,
            axis1=axis1,
            axis2=axis2,
        )


class RigidLink(Block):
    """The second node follows the first as part of the same rigid body. On 2 nodes.

    :param nodes: The nodes. Default: `node`.
    :param node: The only node: a link or spring between it and the ground. Default: `nodes`.
    :param use: Parameters from the set; those given beside it come first. Default: none.
    :param translations_only: the rotations of the second node stay free (a hinge there) (true, false, default
        false).
    :param axis1: Direction of local axis 1. Default: from the first node to the second; +Z for one node.
    :param axis2: Vector in the plane of local axes 1 and 2. Default: the upward direction square to axis 1; +X
        for a vertical one.
    """

    _name = "RigidLink"

    def __init__(
        self,
        *,
        nodes: Any | None = None,
        node: str | None = None,
        use: Any | None = None,
        translations_only: bool | str | None = None,
        axis1: Any | None = None,
        axis2: Any | None = None,
    ) -> None:
        super().__init__(
            nodes=nodes,
            node=node,
            use=use,
            translations_only=translations_only,
            axis1=axis1,
            axis2=axis2,
        )


class Ritz(Block):
    """Load-dependent Ritz vectors, and a static vector for link coordinates that they hold badly.

    :param vectors: How many vectors. Default: chosen by the program.
    :param adequacy: Share of the exact flexibility at every link coordinate that the basis must hold; 0: no
        vectors for links. Default: `0.99`.
    :param tolerance: Error that the reduction may make in any output, as share of its range; estimated in every
        run, but not where it is 1. Default: `0.02`.
    :param enrich: A basis that makes a larger error is enlarged and the run made again; false: the run ends as
        inadequate. Default: `true`.
    """

    _name = "Ritz"

    def __init__(
        self,
        *,
        vectors: int | str | None = None,
        adequacy: Quantity | None = None,
        tolerance: Quantity | None = None,
        enrich: bool | str | None = None,
    ) -> None:
        super().__init__(
            vectors=vectors,
            adequacy=adequacy,
            tolerance=tolerance,
            enrich=enrich,
        )


class RockingBody(Block):
    """Rigid body standing on the ground or a node by base points or a rim, in finite rotation: slides, rocks, rolls,
    overturns. On two nodes, or one and the ground.

    :param nodes: The nodes. Default: `node`.
    :param node: The only node: a link or spring between it and the ground. Default: `nodes`.
    :param use: Parameters from the set; those given beside it come first. Default: none.
    :param base: base points, from the centre of gravity, body upright (m, list of (x, y, z), default absent).
    :param rim_radius: instead of `base`: radius of a circular base (m, > 0, default absent).
    :param rim_depth: depth of the circular base below the centre of gravity (m, > 0, default absent).
    :param kn: contact stiffness of each point, or of the whole rim (N/m, > 0).
    :param damping: contact dashpot of each point or the whole rim, acts only where closed (N·s/m, ≥ 0, default
        0).
    :param pull: the dashpot may pull while the point is closed (true, false, default false).
    :param mu: friction coefficient (–, ≥ 0, default 0).
    :param ks: pre-slip stiffness of each point or the rim; required with friction (N/m, > 0, default absent).
    :param arc_stiffness: stiffness of the whole rim that the arc of drilling friction follows from; none: `kn`
        (N/m, > 0, default absent).
    :param inertia: moments of inertia about X, Y, Z of the body, as in its `Mass`; required where it can rock in
        space (kg·m², 3 numbers, ≥ 0, default absent).
    :param overturned: tilt at which the body counts as overturned, rad (–, > 0, default 1.5707963267948966).
    :param axis1: Direction of local axis 1. Default: from the first node to the second; +Z for one node.
    :param axis2: Vector in the plane of local axes 1 and 2. Default: the upward direction square to axis 1; +X
        for a vertical one.
    :param effective_stiffness: Stiffness that stands for the link in the linear structure (K effective of FNA).
        The link equations take it out again. Default: 0; the basis is made with a thousandth of the stiffness of
        the closed link.
    :param p_delta_at: Where the moment of the axial force over the shear of the link acts (P-Δ): its share at
        either end, the ground as the first for one node; the rest is a couple of shears, for which the nodes must
        be apart. `(1, 0)` for a bearing whose dish lies below. For laws with U1 and U2 or U3. With `p_delta` or
        without. Default: no such moment.
    :param shear_at: Distance from the second node at which the shear of a link with two nodes acts. Default: `0`.
    """

    _name = "RockingBody"

    def __init__(
        self,
        *,
        nodes: Any | None = None,
        node: str | None = None,
        use: Any | None = None,
        base: Sequence[Any] | None = None,
        rim_radius: Quantity | None = None,
        rim_depth: Quantity | None = None,
        kn: Quantity | None = None,
        damping: Quantity | None = None,
        pull: bool | str | None = None,
        mu: Quantity | None = None,
        ks: Quantity | None = None,
        arc_stiffness: Quantity | None = None,
        inertia: Quantity | Sequence[Any] | None = None,
        overturned: Quantity | None = None,
        axis1: Any | None = None,
        axis2: Any | None = None,
        effective_stiffness: Any | None = None,
        p_delta_at: Any | None = None,
        shear_at: Quantity | None = None,
    ) -> None:
        super().__init__(
            nodes=nodes,
            node=node,
            use=use,
            base=base,
            rim_radius=rim_radius,
            rim_depth=rim_depth,
            kn=kn,
            damping=damping,
            pull=pull,
            mu=mu,
            ks=ks,
            arc_stiffness=arc_stiffness,
            inertia=inertia,
            overturned=overturned,
            axis1=axis1,
            axis2=axis2,
            effective_stiffness=effective_stiffness,
            p_delta_at=p_delta_at,
            shear_at=shear_at,
        )


class RubberIsolator(Block):
    """Bearing with plastic shear coupled in its plane and a linear axial spring. On two nodes, or one and the
    ground.

    :param nodes: The nodes. Default: `node`.
    :param node: The only node: a link or spring between it and the ground. Default: `nodes`.
    :param use: Parameters from the set; those given beside it come first. Default: none.
    :param k2: shear stiffness at rest (N/m, > 0).
    :param k3: the same along U3 (k₂) (N/m, > 0, default absent).
    :param fy2: yield force in shear (N, > 0).
    :param fy3: the same along U3 (f_y2) (N, > 0, default absent).
    :param ratio2: stiffness after yielding over `k2` (–, between 0 and 1).
    :param ratio3: the same along U3 (r₂) (–, between 0 and 1, default absent).
    :param kv: axial stiffness, both ways (N/m, ≥ 0, default 0).
    :param coupling: how unloading is told: axis by axis, or by the direction of the motion (Axes, Direction,
        default Axes). One of Axes, Direction.
    :param beta: shape: loading against β + γ, return with γ − β (–, > 0, default 0.5).
    :param gamma: shape, −β < γ ≤ β; at γ = β the return is elastic (–, any, default 0.5).
    :param eta: sharpness of yielding (–, between 1 and 20, default 2).
    :param axis1: Direction of local axis 1. Default: from the first node to the second; +Z for one node.
    :param axis2: Vector in the plane of local axes 1 and 2. Default: the upward direction square to axis 1; +X
        for a vertical one.
    :param effective_stiffness: Stiffness that stands for the link in the linear structure (K effective of FNA).
        The link equations take it out again. Default: 0; the basis is made with a thousandth of the stiffness of
        the closed link.
    :param p_delta_at: Where the moment of the axial force over the shear of the link acts (P-Δ): its share at
        either end, the ground as the first for one node; the rest is a couple of shears, for which the nodes must
        be apart. `(1, 0)` for a bearing whose dish lies below. For laws with U1 and U2 or U3. With `p_delta` or
        without. Default: no such moment.
    :param shear_at: Distance from the second node at which the shear of a link with two nodes acts. Default: `0`.
    """

    _name = "RubberIsolator"
    _words = frozenset({"coupling"})

    def __init__(
        self,
        *,
        nodes: Any | None = None,
        node: str | None = None,
        use: Any | None = None,
        k2: Quantity | None = None,
        k3: Quantity | None = None,
        fy2: Quantity | None = None,
        fy3: Quantity | None = None,
        ratio2: Quantity | None = None,
        ratio3: Quantity | None = None,
        kv: Quantity | None = None,
        coupling: Name | None = None,
        beta: Quantity | None = None,
        gamma: Quantity | None = None,
        eta: Quantity | None = None,
        axis1: Any | None = None,
        axis2: Any | None = None,
        effective_stiffness: Any | None = None,
        p_delta_at: Any | None = None,
        shear_at: Quantity | None = None,
    ) -> None:
        super().__init__(
            nodes=nodes,
            node=node,
            use=use,
            k2=k2,
            k3=k3,
            fy2=fy2,
            fy3=fy3,
            ratio2=ratio2,
            ratio3=ratio3,
            kv=kv,
            coupling=coupling,
            beta=beta,
            gamma=gamma,
            eta=eta,
            axis1=axis1,
            axis2=axis2,
            effective_stiffness=effective_stiffness,
            p_delta_at=p_delta_at,
            shear_at=shear_at,
        )


class SaragoniHart(Block):
    """A smooth rise and fall.

    :param peak_at: Share of the duration at which it peaks. Default: `0.2`.
    :param end: What is left of the peak at the end. Default: `0.05`.
    """

    _name = "SaragoniHart"

    def __init__(
        self,
        *,
        peak_at: Quantity | None = None,
        end: Quantity | None = None,
    ) -> None:
        super().__init__(
            peak_at=peak_at,
            end=end,
        )


class Scaled(Block):
    """Another function times a factor.

    :param function: The function.
    :param factor: The factor, with or without unit.
    """

    _name = "Scaled"

    def __init__(
        self,
        *,
        function: str | None = None,
        factor: Quantity | None = None,
    ) -> None:
        super().__init__(
            function=function,
            factor=factor,
        )


class Section(Block):
    """A rolled section by its name: European IPE, HEA, HEB and HEM (EN 10365), American W (ASTM A6/A6M); or a hollow
    one: `"SHS 150x8"`, `"RHS 200x100x8"`, `"CHS 219.1x10"` in mm (EN 10210, with `cold` behind it EN 10219),
    `"HSS 8x6x1/2"` in inches (ASTM A500). `"HEB 300"` and `Section("HEB 300")` say the same; blanks and capitals
    do not count. Everything is computed from depth, width, thicknesses and root radius.

    :param name: The name.
    """

    _name = "Section"

    def __init__(
        self,
        *,
        name: str | None = None,
    ) -> None:
        super().__init__(
            name=name,
        )


class Sine(Block):
    """amplitude · sin(2π frequency (t − start) + phase).

    :param amplitude: Largest value; its unit is the unit of the function.
    :param frequency: Cycles per second.
    :param cycles: Cycles after which it is zero; 0.5 is a half sine. Default: no end.
    :param start: Time at which it begins; zero before. Default: `0`.
    :param phase: Phase at the start, an angle. Default: `0`.
    """

    _name = "Sine"

    def __init__(
        self,
        *,
        amplitude: Quantity | None = None,
        frequency: Quantity | None = None,
        cycles: Quantity | None = None,
        start: Quantity | None = None,
        phase: Quantity | None = None,
    ) -> None:
        super().__init__(
            amplitude=amplitude,
            frequency=frequency,
            cycles=cycles,
            start=start,
            phase=phase,
        )


class Smallest(Block):
    """Smallest of other outputs.

    :param terms: The outputs, each at the same time.
    :param hidden: Other outputs are made from it, and it is left out of files, report and summary. Default:
        `false`.
    """

    _name = "Smallest"

    def __init__(
        self,
        *,
        terms: Sequence[Any] | None = None,
        hidden: bool | str | None = None,
    ) -> None:
        super().__init__(
            terms=terms,
            hidden=hidden,
        )


class SoilSpring(Block):
    """Soil beside a pile or behind a wall: p–y curve, elastic return, a gap that opens, drag. On two nodes, or one
    and the ground.

    :param nodes: The nodes. Default: `node`.
    :param node: The only node: a link or spring between it and the ground. Default: `nodes`.
    :param use: Parameters from the set; those given beside it come first. Default: none.
    :param k: stiffness where pressing begins (N/m, > 0).
    :param pu: ultimate resistance of a side (N, > 0).
    :param backbone: first pressing: Kondner's hyperbola, or API's hyperbolic tangent for sand (Hyperbolic, Sand,
        default Hyperbolic). One of Hyperbolic, Sand.
    :param ku: stiffness back and again, at least `k`; none: `k` (N/m, > 0, default absent).
    :param opening: clearance before the soil on each side (m, ≥ 0, default 0).
    :param sides: where soil is: at which deformations it presses (Both, Positive, Negative, default Both). One of
        Both, Positive, Negative.
    :param drag: friction along the sides, in the gap as well (N, ≥ 0, default 0).
    :param drag_stiffness: stiffness before it slips; none: `k` (N/m, > 0, default absent).
    :param axis: local axis (U1, U2, U3, default U2). One of U1, U2, U3.
    :param axis1: Direction of local axis 1. Default: from the first node to the second; +Z for one node.
    :param axis2: Vector in the plane of local axes 1 and 2. Default: the upward direction square to axis 1; +X
        for a vertical one.
    :param effective_stiffness: Stiffness that stands for the link in the linear structure (K effective of FNA).
        The link equations take it out again. Default: 0; the basis is made with a thousandth of the stiffness of
        the closed link.
    :param p_delta_at: Where the moment of the axial force over the shear of the link acts (P-Δ): its share at
        either end, the ground as the first for one node; the rest is a couple of shears, for which the nodes must
        be apart. `(1, 0)` for a bearing whose dish lies below. For laws with U1 and U2 or U3. With `p_delta` or
        without. Default: no such moment.
    :param shear_at: Distance from the second node at which the shear of a link with two nodes acts. Default: `0`.
    """

    _name = "SoilSpring"
    _words = frozenset({"axis", "backbone", "sides"})

    def __init__(
        self,
        *,
        nodes: Any | None = None,
        node: str | None = None,
        use: Any | None = None,
        k: Quantity | None = None,
        pu: Quantity | None = None,
        backbone: Name | None = None,
        ku: Quantity | None = None,
        opening: Quantity | None = None,
        sides: Name | None = None,
        drag: Quantity | None = None,
        drag_stiffness: Quantity | None = None,
        axis: Name | None = None,
        axis1: Any | None = None,
        axis2: Any | None = None,
        effective_stiffness: Any | None = None,
        p_delta_at: Any | None = None,
        shear_at: Quantity | None = None,
    ) -> None:
        super().__init__(
            nodes=nodes,
            node=node,
            use=use,
            k=k,
            pu=pu,
            backbone=backbone,
            ku=ku,
            opening=opening,
            sides=sides,
            drag=drag,
            drag_stiffness=drag_stiffness,
            axis=axis,
            axis1=axis1,
            axis2=axis2,
            effective_stiffness=effective_stiffness,
            p_delta_at=p_delta_at,
            shear_at=shear_at,
        )


class Spring(Block):
    """Linear spring and dashpot in six directions, between two nodes or to the ground. On two nodes, or one and the
    ground.

    :param nodes: The nodes. Default: `node`.
    :param node: The only node: a link or spring between it and the ground. Default: `nodes`.
    :param use: Parameters from the set; those given beside it come first. Default: none.
    :param k1: stiffness along local 1 (N/m, ≥ 0, default 0).
    :param k2: stiffness along local 2 (N/m, ≥ 0, default 0).
    :param k3: stiffness along local 3 (N/m, ≥ 0, default 0).
    :param r1: stiffness about local 1 (N·m, ≥ 0, default 0).
    :param r2: stiffness about local 2 (N·m, ≥ 0, default 0).
    :param r3: stiffness about local 3 (N·m, ≥ 0, default 0).
    :param c1: damping along local 1 (N·s/m, ≥ 0, default 0).
    :param c2: damping along local 2 (N·s/m, ≥ 0, default 0).
    :param c3: damping along local 3 (N·s/m, ≥ 0, default 0).
    :param cr1: damping about local 1 (N·m·s, ≥ 0, default 0).
    :param cr2: damping about local 2 (N·m·s, ≥ 0, default 0).
    :param cr3: damping about local 3 (N·m·s, ≥ 0, default 0).
    :param stiffness: full matrix in local axes, added to the diagonal entries (N/m, 6 × 6, symmetric, default
        absent).
    :param damping: full matrix in local axes, added to the diagonal entries (N·s/m, 6 × 6, symmetric, default
        absent).
    :param axis1: Direction of local axis 1. Default: from the first node to the second; +Z for one node.
    :param axis2: Vector in the plane of local axes 1 and 2. Default: the upward direction square to axis 1; +X
        for a vertical one.
    """

    _name = "Spring"

    def __init__(
        self,
        *,
        nodes: Any | None = None,
        node: str | None = None,
        use: Any | None = None,
        k1: Quantity | None = None,
        k2: Quantity | None = None,
        k3: Quantity | None = None,
        r1: Quantity | None = None,
        r2: Quantity | None = None,
        r3: Quantity | None = None,
        c1: Quantity | None = None,
        c2: Quantity | None = None,
        c3: Quantity | None = None,
        cr1: Quantity | None = None,
        cr2: Quantity | None = None,
        cr3: Quantity | None = None,
        stiffness: Sequence[Any] | None = None,
        damping: Sequence[Any] | None = None,
        axis1: Any | None = None,
        axis2: Any | None = None,
    ) -> None:
        super().__init__(
            nodes=nodes,
            node=node,
            use=use,
            k1=k1,
            k2=k2,
            k3=k3,
            r1=r1,
            r2=r2,
            r3=r3,
            c1=c1,
            c2=c2,
            c3=c3,
            cr1=cr1,
            cr2=cr2,
            cr3=cr3,
            stiffness=stiffness,
            damping=damping,
            axis1=axis1,
            axis2=axis2,
        )


class Srss(Block):
    """Root of the sum of the squares of the largest magnitudes, to both sides.

    :param cases: Cases, and combinations that stand before, with their factors; names in a list have the factor
        1.
    """

    _name = "Srss"

    def __init__(
        self,
        *,
        cases: Any | None = None,
    ) -> None:
        super().__init__(
            cases=cases,
        )


class Static(Block):
    """Nonlinear statics: loads grow from nothing, or from the case before, to their value.

    :param after: Earlier case whose end is the start: displacements, link histories and loads are carried on.
        Default: from rest, unloaded.
    :param loads: Loads that are added.
    :param steps: Load steps at least; halved where they do not converge, and where laws bend inside them.
        Default: `1`.
    """

    _name = "Static"

    def __init__(
        self,
        *,
        after: str | None = None,
        loads: Sequence[Any] | None = None,
        steps: int | str | None = None,
    ) -> None:
        super().__init__(
            after=after,
            loads=loads,
            steps=steps,
        )


class Stationary(Block):
    """The same all the time."""

    _name = "Stationary"


class Steel(Block):
    """Structural steel (EN 1993-1-1, 3.2.6). American practice takes `Steel(young: "29000 ksi")`.

    :param young: Young's modulus. Default: `"210 GPa"`.
    :param poisson: Poisson's ratio. Default: `0.3`.
    :param density: Density. Default: `"7850 kg/m^3"`.
    :param expansion: Strain by one kelvin. Default: `1.2e-5`.
    """

    _name = "Steel"

    def __init__(
        self,
        *,
        young: Quantity | None = None,
        poisson: Quantity | None = None,
        density: Quantity | None = None,
        expansion: Quantity | None = None,
    ) -> None:
        super().__init__(
            young=young,
            poisson=poisson,
            density=density,
            expansion=expansion,
        )


class Step(Block):
    """A value from a time on, or between two times.

    :param amplitude: Largest value; its unit is the unit of the function.
    :param start: Time at which it begins; zero before. Default: `0`.
    :param end: Time after which it is zero. Default: no end.
    """

    _name = "Step"

    def __init__(
        self,
        *,
        amplitude: Quantity | None = None,
        start: Quantity | None = None,
        end: Quantity | None = None,
    ) -> None:
        super().__init__(
            amplitude=amplitude,
            start=start,
            end=end,
        )


class StoreyDrift(Block):
    """Displacement of a node against one below it, over the height between them.

    :param of: The nodes.
    :param dof: Direction. One of Ux, Uy.
    :param hidden: Other outputs are made from it, and it is left out of files, report and summary. Default:
        `false`.
    """

    _name = "StoreyDrift"
    _words = frozenset({"dof"})

    def __init__(
        self,
        *,
        of: Any | None = None,
        dof: Name | None = None,
        hidden: bool | str | None = None,
    ) -> None:
        super().__init__(
            of=of,
            dof=dof,
            hidden=hidden,
        )


class Sum(Block):
    """Sum of other outputs.

    :param terms: The outputs, each at the same time.
    :param constant: A number that is added. Default: `0`.
    :param hidden: Other outputs are made from it, and it is left out of files, report and summary. Default:
        `false`.
    """

    _name = "Sum"

    def __init__(
        self,
        *,
        terms: Sequence[Any] | None = None,
        constant: Quantity | None = None,
        hidden: bool | str | None = None,
    ) -> None:
        super().__init__(
            terms=terms,
            constant=constant,
            hidden=hidden,
        )


class Superelement(Block):
    """A structure by its matrices, made by another program: a wall, a slab, a tank, a machine. On 1 nodes or more.

    :param nodes: The nodes. Default: `node`.
    :param node: The only node: a link or spring between it and the ground. Default: `nodes`.
    :param use: Parameters from the set; those given beside it come first. Default: none.
    :param stiffness: stiffness matrix in global axes and SI (N/m, N, N·m) (path of a `.mtx`, `.npz`, `.sti`,
        `.mas` or `.pch` file).
    :param mass: mass matrix (kg, kg·m, kg·m²); without it there is no mass (path of a `.mtx`, `.npz`, `.sti`,
        `.mas` or `.pch` file, default absent).
    :param damping: damping matrix (N·s/m, N·s, N·m·s), beside what `damping` of the model gives (path of a
        `.mtx`, `.npz`, `.sti`, `.mas` or `.pch` file, default absent).
    :param rows: what rows are: CSV file `row,node,dof`, number of a row, from 1, label of its node, and `Ux` …
        `Rz`, or the `.dof` of CalculiX; not with `.pch`, which says so itself (path of a text file, default
        absent).
    :param labels: what the files call its nodes, in their order; instead, `nodes` may be a map from labels to
        nodes. Without either the files use the names of the nodes (a text for each node, default absent).
    :param recovery: directions of nodes that are no rows and follow them, `u = R u_rows`: CSV file
        `node,dof,row,value`, label of the node, `Ux` … `Rz`, number of a row, from 1, and its share (path of a
        text file, default absent).
    :param axis1: Direction of local axis 1. Default: from the first node to the second; +Z for one node.
    :param axis2: Vector in the plane of local axes 1 and 2. Default: the upward direction square to axis 1; +X
        for a vertical one.
    """

    _name = "Superelement"

    def __init__(
        self,
        *,
        nodes: Any | None = None,
        node: str | None = None,
        use: Any | None = None,
        stiffness: Block | str | None = None,
        mass: Block | str | None = None,
        damping: Block | str | None = None,
        rows: Block | str | None = None,
        labels: Sequence[Any] | None = None,
        recovery: Block | str | None = None,
        axis1: Any | None = None,
        axis2: Any | None = None,
    ) -> None:
        super().__init__(
            nodes=nodes,
            node=node,
            use=use,
            stiffness=stiffness,
            mass=mass,
            damping=damping,
            rows=rows,
            labels=labels,
            recovery=recovery,
            axis1=axis1,
            axis2=axis2,
        )


class Synthetic(Block):
    """A synthetic motion: white noise through the filters of Kanai, Tajimi, Clough and Penzien, under an envelope;
    or, with `spectrum`, brought to a response spectrum.

    :param seed: Another seed is another motion.
    :param duration: Length. Default: `"20 s"`.
    :param dt: Time step. Default: `"10 ms"`.
    :param peak: Largest acceleration. Default: for `spectrum`.
    :param frequency: Frequency of the ground. Default: `"2.5 Hz"`.
    :param damping: Damping of the ground, share of critical. Default: `0.6`.
    :param highpass: Frequency of the high-pass of Clough and Penzien. Default: `"0.25 Hz"`.
    :param highpass_damping: Its damping. Default: `0.6`.
    :param envelope: Strength in time. Default: `SaragoniHart`.
    :param spectrum: Response spectrum that the motion meets, in place of `peak`. Default: none.
    :param spectrum_damping: Damping of that spectrum. Default: `0.05`.
    :param scale: Factor. Default: `1`.
    :param after_end: After the last sample: no case may last longer, zero, or the last value. One of Error, Zero,
        Hold. Default: `Zero`.
    """

    _name = "Synthetic"
    _words = frozenset({"after_end", "envelope"})

    def __init__(
        self,
        *,
        seed: int | str | None = None,
        duration: Quantity | None = None,
        dt: Quantity | None = None,
        peak: Quantity | None = None,
        frequency: Quantity | None = None,
        damping: Quantity | None = None,
        highpass: Quantity | None = None,
        highpass_damping: Quantity | None = None,
        envelope: Name | Block | Mapping[str, Any] | None = None,
        spectrum: Any | None = None,
        spectrum_damping: Quantity | None = None,
        scale: Quantity | None = None,
        after_end: Name | None = None,
    ) -> None:
        super().__init__(
            seed=seed,
            duration=duration,
            dt=dt,
            peak=peak,
            frequency=frequency,
            damping=damping,
            highpass=highpass,
            highpass_damping=highpass_damping,
            envelope=envelope,
            spectrum=spectrum,
            spectrum_damping=spectrum_damping,
            scale=scale,
            after_end=after_end,
        )


class Table(Block):
    """Two columns of a CSV file: time and value. Lines that begin with # are comments; a header row may name the
    columns.

    :param file: The file.
    :param time: Column of times. Default: `0`.
    :param value: Column of values. Default: `1`.
    :param unit: Unit of the values. Default: plain numbers.
    :param scale: Factor of the values. Default: `1`.
    :param skip: Rows to skip at the top. Default: `0`.
    :param interpolation: Between samples: straight lines, or a natural cubic spline. One of Linear, Cubic.
        Default: `Linear`.
    :param after_end: After the last sample: no case may last longer, zero, or the last value. One of Error, Zero,
        Hold. Default: `Error`.
    """

    _name = "Table"
    _words = frozenset({"after_end", "interpolation"})

    def __init__(
        self,
        *,
        file: Any | None = None,
        time: Any | None = None,
        value: Any | None = None,
        unit: str | None = None,
        scale: Quantity | None = None,
        skip: int | str | None = None,
        interpolation: Name | None = None,
        after_end: Name | None = None,
    ) -> None:
        super().__init__(
            file=file,
            time=time,
            value=value,
            unit=unit,
            scale=scale,
            skip=skip,
            interpolation=interpolation,
            after_end=after_end,
        )


class Temperature(Block):
    """A member that is warmer than it was made, in kelvin. It has an `expansion`, its own or that of its `material`.

    :param element: The beam or truss, or a group of them: each.
    :param rise: On the axis. Default: `0`.
    :param gradient_2: By length towards positive local 2. Default: `0`.
    :param gradient_3: By length towards positive local 3. Default: `0`.
    """

    _name = "Temperature"

    def __init__(
        self,
        *,
        element: str | None = None,
        rise: Quantity | None = None,
        gradient_2: Quantity | None = None,
        gradient_3: Quantity | None = None,
    ) -> None:
        super().__init__(
            element=element,
            rise=rise,
            gradient_2=gradient_2,
            gradient_3=gradient_3,
        )


class TensionCompressionFriction(Block):
    """Sliding bearing with friction in compression and, of its own, in tension. On two nodes, or one and the ground.

    :param nodes: The nodes. Default: `node`.
    :param node: The only node: a link or spring between it and the ground. Default: `nodes`.
    :param use: Parameters from the set; those given beside it come first. Default: none.
    :param kn: stiffness in compression (N/m, > 0).
    :param kt: stiffness in tension (N/m, > 0).
    :param gap_compression: clearance before compression (m, ≥ 0, default 0).
    :param gap_tension: clearance before tension (m, ≥ 0, default 0).
    :param damping: dashpot along the axis, acts only while closed (N·s/m, ≥ 0, default 0).
    :param pull: the dashpot may act against the contact force; N is that of the spring then (true, false, default
        false).
    :param ks: stiffness before slip (N/m, > 0).
    :param cs: dashpot beside the spring `ks`: damps a bearing that sticks (N·s/m, ≥ 0, default 0).
    :param radius: effective radius; 0 is flat (m, ≥ 0, default 0).
    :param mu: friction coefficient in compression; none: no friction (–, ≥ 0, default absent).
    :param mu_slow: instead of `mu`: friction coefficient at rest (–, ≥ 0, default absent).
    :param mu_fast: instead of `mu`: friction coefficient at speed (–, ≥ 0, default absent).
    :param rate: how fast the friction coefficient goes from slow to fast (s/m, ≥ 0, default absent).
    :param mu_tension: friction coefficient in tension; none: as compression (–, ≥ 0, default absent).
    :param mu_slow_tension: instead of `mu_tension`: at rest (–, ≥ 0, default absent).
    :param mu_fast_tension: instead of `mu_tension`: at speed (–, ≥ 0, default absent).
    :param rate_tension: how fast it goes from slow to fast in tension (s/m, ≥ 0, default absent).
    :param axis1: Direction of local axis 1. Default: from the first node to the second; +Z for one node.
    :param axis2: Vector in the plane of local axes 1 and 2. Default: the upward direction square to axis 1; +X
        for a vertical one.
    :param effective_stiffness: Stiffness that stands for the link in the linear structure (K effective of FNA).
        The link equations take it out again. Default: 0; the basis is made with a thousandth of the stiffness of
        the closed link.
    :param p_delta_at: Where the moment of the axial force over the shear of the link acts (P-Δ): its share at
        either end, the ground as the first for one node; the rest is a couple of shears, for which the nodes must
        be apart. `(1, 0)` for a bearing whose dish lies below. For laws with U1 and U2 or U3. With `p_delta` or
        without. Default: no such moment.
    :param shear_at: Distance from the second node at which the shear of a link with two nodes acts. Default: `0`.
    """

    _name = "TensionCompressionFriction"

    def __init__(
        self,
        *,
        nodes: Any | None = None,
        node: str | None = None,
        use: Any | None = None,
        kn: Quantity | None = None,
        kt: Quantity | None = None,
        gap_compression: Quantity | None = None,
        gap_tension: Quantity | None = None,
        damping: Quantity | None = None,
        pull: bool | str | None = None,
        ks: Quantity | None = None,
        cs: Quantity | None = None,
        radius: Quantity | None = None,
        mu: Quantity | None = None,
        mu_slow: Quantity | None = None,
        mu_fast: Quantity | None = None,
        rate: Quantity | None = None,
        mu_tension: Quantity | None = None,
        mu_slow_tension: Quantity | None = None,
        mu_fast_tension: Quantity | None = None,
        rate_tension: Quantity | None = None,
        axis1: Any | None = None,
        axis2: Any | None = None,
        effective_stiffness: Any | None = None,
        p_delta_at: Any | None = None,
        shear_at: Quantity | None = None,
    ) -> None:
        super().__init__(
            nodes=nodes,
            node=node,
            use=use,
            kn=kn,
            kt=kt,
            gap_compression=gap_compression,
            gap_tension=gap_tension,
            damping=damping,
            pull=pull,
            ks=ks,
            cs=cs,
            radius=radius,
            mu=mu,
            mu_slow=mu_slow,
            mu_fast=mu_fast,
            rate=rate,
            mu_tension=mu_tension,
            mu_slow_tension=mu_slow_tension,
            mu_fast_tension=mu_fast_tension,
            rate_tension=rate_tension,
            axis1=axis1,
            axis2=axis2,
            effective_stiffness=effective_stiffness,
            p_delta_at=p_delta_at,
            shear_at=shear_at,
        )


class Trapezoid(Block):
    """A force, or moment, by length that runs straight between points; nothing beyond them.

    :param element: The beam or truss, or a group of them: each.
    :param dof: Global direction. One of Ux, Uy, Uz, Rx, Ry, Rz. Default: `axis`.
    :param axis: Local axis instead. One of U1, U2, U3, R1, R2, R3. Default: `dof`.
    :param points: Places are distances from the first node, or shares such as `"50 %"`.
    :param projected: By length as seen along `dof`, as snow lies: less on a member that is inclined. Default:
        `false`.
    """

    _name = "Trapezoid"
    _words = frozenset({"axis", "dof"})

    def __init__(
        self,
        *,
        element: str | None = None,
        dof: Name | None = None,
        axis: Name | None = None,
        points: Any | None = None,
        projected: bool | str | None = None,
    ) -> None:
        super().__init__(
            element=element,
            dof=dof,
            axis=axis,
            points=points,
            projected=projected,
        )


class TriplePendulum(Block):
    """Sliding bearing with four concave surfaces and their rims. On two nodes, or one and the ground.

    :param nodes: The nodes. Default: `node`.
    :param node: The only node: a link or spring between it and the ground. Default: `nodes`.
    :param use: Parameters from the set; those given beside it come first. Default: none.
    :param kn: stiffness in compression (N/m, > 0).
    :param damping: dashpot along the axis, acts only while closed (N·s/m, ≥ 0, default 0).
    :param pull: the dashpot may pull while closed; friction is of kₙ d₁ then (true, false, default false).
    :param ks: stiffness before slip of each surface (N/m, > 0).
    :param radii: radii of surfaces 1 to 4 (m, 4 numbers, any).
    :param heights: distances of the surfaces from the pivot point, taken off the radii; none: 0 (m, 4 numbers,
        any, default absent).
    :param capacities: displacements at which the surfaces meet their rims; 0: no rim (m, 4 numbers, any, default
        absent).
    :param stop_stiffness: stiffness of each rim; required with `capacities` (N/m, > 0, default absent).
    :param mu: friction coefficients (–, 4 numbers, any, default absent).
    :param mu_slow: instead of `mu`: at rest (–, 4 numbers, any, default absent).
    :param mu_fast: instead of `mu`: at speed (–, 4 numbers, any, default absent).
    :param rate: how fast μ goes from slow to fast (s/m, 4 numbers, any, default absent).
    :param axis1: Direction of local axis 1. Default: from the first node to the second; +Z for one node.
    :param axis2: Vector in the plane of local axes 1 and 2. Default: the upward direction square to axis 1; +X
        for a vertical one.
    :param effective_stiffness: Stiffness that stands for the link in the linear structure (K effective of FNA).
        The link equations take it out again. Default: 0; the basis is made with a thousandth of the stiffness of
        the closed link.
    :param p_delta_at: Where the moment of the axial force over the shear of the link acts (P-Δ): its share at
        either end, the ground as the first for one node; the rest is a couple of shears, for which the nodes must
        be apart. `(1, 0)` for a bearing whose dish lies below. For laws with U1 and U2 or U3. With `p_delta` or
        without. Default: no such moment.
    :param shear_at: Distance from the second node at which the shear of a link with two nodes acts. Default: `0`.
    """

    _name = "TriplePendulum"

    def __init__(
        self,
        *,
        nodes: Any | None = None,
        node: str | None = None,
        use: Any | None = None,
        kn: Quantity | None = None,
        damping: Quantity | None = None,
        pull: bool | str | None = None,
        ks: Quantity | None = None,
        radii: Quantity | Sequence[Any] | None = None,
        heights: Quantity | Sequence[Any] | None = None,
        capacities: Quantity | Sequence[Any] | None = None,
        stop_stiffness: Quantity | None = None,
        mu: Quantity | Sequence[Any] | None = None,
        mu_slow: Quantity | Sequence[Any] | None = None,
        mu_fast: Quantity | Sequence[Any] | None = None,
        rate: Quantity | Sequence[Any] | None = None,
        axis1: Any | None = None,
        axis2: Any | None = None,
        effective_stiffness: Any | None = None,
        p_delta_at: Any | None = None,
        shear_at: Quantity | None = None,
    ) -> None:
        super().__init__(
            nodes=nodes,
            node=node,
            use=use,
            kn=kn,
            damping=damping,
            pull=pull,
            ks=ks,
            radii=radii,
            heights=heights,
            capacities=capacities,
            stop_stiffness=stop_stiffness,
            mu=mu,
            mu_slow=mu_slow,
            mu_fast=mu_fast,
            rate=rate,
            axis1=axis1,
            axis2=axis2,
            effective_stiffness=effective_stiffness,
            p_delta_at=p_delta_at,
            shear_at=shear_at,
        )


class Truss(Block):
    """Two-node bar that carries axial force only. On 2 nodes.

    :param nodes: The nodes. Default: `node`.
    :param node: The only node: a link or spring between it and the ground. Default: `nodes`.
    :param use: Parameters from the set; those given beside it come first. Default: none.
    :param young: Young's modulus (N/m², > 0).
    :param area: area of the section (m², > 0).
    :param density: density, for the mass (kg/m³, ≥ 0, default 0).
    :param distributed_mass: further mass per length (kg/m, ≥ 0, default 0).
    :param expansion: strain by one kelvin, for loads of warmth (–, > 0, default absent).
    :param mass_matrix: how the mass is spread (Lumped, Consistent, default Lumped). One of Lumped, Consistent.
    :param axis1: Direction of local axis 1. Default: from the first node to the second; +Z for one node.
    :param axis2: Vector in the plane of local axes 1 and 2. Default: the upward direction square to axis 1; +X
        for a vertical one.
    """

    _name = "Truss"
    _words = frozenset({"mass_matrix"})

    def __init__(
        self,
        *,
        nodes: Any | None = None,
        node: str | None = None,
        use: Any | None = None,
        young: Quantity | None = None,
        area: Quantity | None = None,
        density: Quantity | None = None,
        distributed_mass: Quantity | None = None,
        expansion: Quantity | None = None,
        mass_matrix: Name | None = None,
        axis1: Any | None = None,
        axis2: Any | None = None,
    ) -> None:
        super().__init__(
            nodes=nodes,
            node=node,
            use=use,
            young=young,
            area=area,
            density=density,
            distributed_mass=distributed_mass,
            expansion=expansion,
            mass_matrix=mass_matrix,
            axis1=axis1,
            axis2=axis2,
        )


class Uniform(Block):
    """The same force, or moment, by length.

    :param element: The beam or truss, or a group of them: each.
    :param dof: Global direction. One of Ux, Uy, Uz, Rx, Ry, Rz. Default: `axis`.
    :param axis: Local axis instead. One of U1, U2, U3, R1, R2, R3. Default: `dof`.
    :param force: Force by length of the member. Default: for a rotation.
    :param moment: Moment by length. Default: for a translation.
    :param from_: Where it begins. Default: the first node.
    :param to: Where it ends. Default: the second node.
    :param projected: By length as seen along `dof`, as snow lies: less on a member that is inclined. Default:
        `false`.
    """

    _name = "Uniform"
    _words = frozenset({"axis", "dof"})

    def __init__(
        self,
        *,
        element: str | None = None,
        dof: Name | None = None,
        axis: Name | None = None,
        force: Quantity | None = None,
        moment: Quantity | None = None,
        from_: Any | None = None,
        to: Any | None = None,
        projected: bool | str | None = None,
    ) -> None:
        super().__init__(
            element=element,
            dof=dof,
            axis=axis,
            force=force,
            moment=moment,
            to=to,
            projected=projected,
            **{"from": from_},
        )


class Velocity(Block):
    """Velocity, relative to the base.

    :param node: The node. Default: `terms`.
    :param dof: Direction. One of Ux, Uy, Uz, Rx, Ry, Rz. Default: `terms`.
    :param factor: Factor, with or without unit. Default: `1`.
    :param terms: Several terms that are added, such as a drift; in place of `node` and `dof`. Default: a single
        term.
    :param hidden: Other outputs are made from it, and it is left out of files, report and summary. Default:
        `false`.
    """

    _name = "Velocity"
    _words = frozenset({"dof"})

    def __init__(
        self,
        *,
        node: str | None = None,
        dof: Name | None = None,
        factor: Quantity | None = None,
        terms: Sequence[Any] | None = None,
        hidden: bool | str | None = None,
    ) -> None:
        super().__init__(
            node=node,
            dof=dof,
            factor=factor,
            terms=terms,
            hidden=hidden,
        )


class Wen(Block):
    """Plastic spring with a smooth yield (Wen). On two nodes, or one and the ground.

    :param nodes: The nodes. Default: `node`.
    :param node: The only node: a link or spring between it and the ground. Default: `nodes`.
    :param use: Parameters from the set; those given beside it come first. Default: none.
    :param k: stiffness at rest (N/m or N·m, > 0).
    :param fy: force at which it yields (N or N·m, > 0).
    :param ratio: stiffness after yielding over `k` (–, between 0 and 1).
    :param exponent: sharpness of yielding; above 20 nearly bilinear (–, between 1 and 1000, default 2).
    :param axis: local axis (U1, U2, U3, R1, R2, R3, default U1). One of U1, U2, U3, R1, R2, R3.
    :param axis1: Direction of local axis 1. Default: from the first node to the second; +Z for one node.
    :param axis2: Vector in the plane of local axes 1 and 2. Default: the upward direction square to axis 1; +X
        for a vertical one.
    :param effective_stiffness: Stiffness that stands for the link in the linear structure (K effective of FNA).
        The link equations take it out again. Default: 0; the basis is made with a thousandth of the stiffness of
        the closed link.
    :param p_delta_at: Where the moment of the axial force over the shear of the link acts (P-Δ): its share at
        either end, the ground as the first for one node; the rest is a couple of shears, for which the nodes must
        be apart. `(1, 0)` for a bearing whose dish lies below. For laws with U1 and U2 or U3. With `p_delta` or
        without. Default: no such moment.
    :param shear_at: Distance from the second node at which the shear of a link with two nodes acts. Default: `0`.
    """

    _name = "Wen"
    _words = frozenset({"axis"})

    def __init__(
        self,
        *,
        nodes: Any | None = None,
        node: str | None = None,
        use: Any | None = None,
        k: Quantity | None = None,
        fy: Quantity | None = None,
        ratio: Quantity | None = None,
        exponent: Quantity | None = None,
        axis: Name | None = None,
        axis1: Any | None = None,
        axis2: Any | None = None,
        effective_stiffness: Any | None = None,
        p_delta_at: Any | None = None,
        shear_at: Quantity | None = None,
    ) -> None:
        super().__init__(
            nodes=nodes,
            node=node,
            use=use,
            k=k,
            fy=fy,
            ratio=ratio,
            exponent=exponent,
            axis=axis,
            axis1=axis1,
            axis2=axis2,
            effective_stiffness=effective_stiffness,
            p_delta_at=p_delta_at,
            shear_at=shear_at,
        )


__all__ = [
    "AT2",
    "AbsoluteAdd",
    "Acceleration",
    "Adaptive",
    "All",
    "Aluminium",
    "Always",
    "Approach",
    "Axes",
    "BandLimited",
    "BaseShear",
    "Beam",
    "Bending",
    "BilinearDamper",
    "BodyContact",
    "Both",
    "BoucWen",
    "Box",
    "Butterworth",
    "COSMOS",
    "CSMIP",
    "Circle",
    "Columns",
    "Complete",
    "Compression",
    "Concrete",
    "Consistent",
    "Constant",
    "Contact",
    "Cosine",
    "Coulomb",
    "Cubic",
    "Dashpot",
    "Diaphragm",
    "Direction",
    "Displacement",
    "Dynamic",
    "ESM",
    "Eigen",
    "ElastomericBearing",
    "ElementForce",
    "Envelope",
    "EqualDof",
    "Error",
    "Fixed",
    "FixedPoint",
    "Fna",
    "For",
    "FrequencyIndependentViscoelastic",
    "FrictionPendulum",
    "FrictionSpring",
    "FullNewton",
    "Gap",
    "Gravity",
    "HalfSine",
    "Hertzdamp",
    "Hht",
    "Hold",
    "Hook",
    "Hyperbolic",
    "IShape",
    "IbarraMedinaKrawinkler",
    "ImpactHertz",
    "ImpactKelvin",
    "InContact",
    "Inerter",
    "Isotropic",
    "Iwan",
    "Jankowski",
    "Jennings",
    "KNET",
    "Keep",
    "Kinematic",
    "Largest",
    "LeadRubber",
    "Linear",
    "LinearAdd",
    "LinearLink",
    "LinkDeformation",
    "LinkForce",
    "LinkHistory",
    "Lumped",
    "M2",
    "M3",
    "Mass",
    "MaxwellDamper",
    "Mean",
    "MemberForce",
    "Modal",
    "ModalTable",
    "MultilinearElastic",
    "MultilinearPlastic",
    "N",
    "NLink",
    "Negative",
    "Newton",
    "Norm",
    "Overturning",
    "PMMHinge",
    "PeakOriented",
    "Pinching",
    "Pipe",
    "Pivot",
    "Point",
    "Points",
    "Polynomial",
    "Positive",
    "R1",
    "R2",
    "R3",
    "Ramp",
    "Rayleigh",
    "RayleighAt",
    "Reaction",
    "Record",
    "Rectangle",
    "Rest",
    "Ricker",
    "RigidBody",
    "RigidLink",
    "Ritz",
    "RitzHht",
    "RockingBody",
    "RubberIsolator",
    "Rx",
    "Ry",
    "Rz",
    "Sand",
    "SaragoniHart",
    "Scaled",
    "Section",
    "Shallow",
    "Sine",
    "Smallest",
    "SoilSpring",
    "Spherical",
    "Spring",
    "Srss",
    "Static",
    "Stationary",
    "Steel",
    "Step",
    "StoreyDrift",
    "Strip",
    "Sum",
    "Superelement",
    "Synthetic",
    "T",
    "Table",
    "Takeda",
    "Temperature",
    "Tension",
    "TensionCompressionFriction",
    "Trapezoid",
    "TriplePendulum",
    "Truss",
    "U1",
    "U2",
    "U3",
    "Uniform",
    "Ux",
    "Uy",
    "Uz",
    "V2",
    "V3",
    "Velocity",
    "VelocityForce",
    "VelocityPressure",
    "Wen",
    "X",
    "XY",
    "XZ",
    "Y",
    "YZ",
    "Z",
    "Zero",
]
