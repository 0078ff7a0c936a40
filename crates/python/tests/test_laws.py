"""Laws of links of one's own: plain, compiled by numba where it is there, and in C."""

from __future__ import annotations

import copy
import pickle
import shutil
import signal
import subprocess
import sys
import threading
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import ROOT

import trilith as tl

try:
    import numba  # noqa: F401

    WAYS = [False, True]
except ImportError:
    WAYS = [False]
NUMBA = len(WAYS) == 2
with_numba = pytest.mark.skipif(not NUMBA, reason="numba is not installed: laws are tested as plain Python alone")


class Slider(tl.Law):
    """Spring that slips.

    f = k (d - p), |f| <= fy
    """

    k: float = tl.parameter("N/m", range="> 0", meaning="stiffness", example="100 kN/m")
    fy: float = tl.parameter("N", default="0.5 kN", range="> 0", meaning="force at which it slips")
    history = {"slip": "m"}
    rates = False
    amplitude = 0.02

    def force(self, d: Any, v: Any, history: Any) -> Any:
        q = min(max(self.k * (d[0] - history.slip), -self.fy), self.fy)
        return q, (d[0] - q / self.k,)

    def tangent(self, d: Any, v: Any, history: Any) -> Any:
        return self.k if abs(self.k * (d[0] - history.slip)) < self.fy else 0.0

    def energy(self, d: Any, v: Any, history: Any, step: Any) -> Any:
        q = self.k * (d[0] - history.slip)
        return 0.5 * q * q / self.k, q * (history.slip - step.history0.slip), 0.0


class Silent(tl.Law):
    """The same without tangent and energy."""

    k: float = tl.parameter("N/m")
    fy: float = tl.parameter("N", default="0.5 kN")
    history = {"slip": "m"}
    rates = False
    compiled = False

    def force(self, d: Any, v: Any, history: Any) -> Any:
        return Slider.force(self, d, v, history)  # type: ignore[arg-type]


class Coupled(tl.Law):
    """Two springs and two dashpots that know of each other."""

    k: float = tl.parameter("N/m")
    c: float = tl.parameter("N*s/m", default=0.0)
    axes = ("U2", "U3")

    def force(self, d: Any, v: Any, history: Any) -> Any:
        return (
            self.k * (2 * d[0] + d[1]) + self.c * v[0],
            self.k * (d[0] + 2 * d[1]) + self.c * v[1],
        )

    def tangent(self, d: Any, v: Any, history: Any) -> Any:
        return self.k * np.array([[2.0, 1.0], [1.0, 2.0]]), ((self.c, 0.0), (0.0, self.c))

    def energy(self, d: Any, v: Any, history: Any, step: Any) -> Any:
        stored = self.k * (d[0] ** 2 + d[0] * d[1] + d[1] ** 2)
        heat = self.c * step.dt / 3 * np.sum(v * v + v * step.v0 + step.v0 * step.v0)
        return stored, 0.0, heat


class Failing(tl.Law):
    """Holds up to a deformation, and goes wrong there in one of several ways."""

    k: float = tl.parameter("N/m", default=1e5)
    end: float = tl.parameter("m", default=0.02)
    way: float = tl.parameter(default=0.0)
    rates = False
    compiled = False

    def force(self, d: Any, v: Any, history: Any) -> Any:
        if d[0] > self.end:
            if self.way == 0:
                raise tl.Refusal(f"torn at {1e3 * self.end:g} mm")
            if self.way == 1:
                nothing: dict[str, float] = {}
                return nothing["nothing"]
            if self.way == 2:
                return float("nan")
            if self.way == 3:
                return [1.0, 2.0]
            if self.way == 4:
                return "much"
        return self.k * d[0]

    def energy(self, d: Any, v: Any, history: Any) -> Any:
        return 0.5 * self.k * d[0] ** 2, 0.0, 0.0


def model(link: str, laws: Any, **parameters: object) -> tl.Model:
    """A mass of 1 t that is kicked against a link."""
    return tl.loads(
        f"""(
    plane: XZ,
    parameters: {{ "v": "1 m/s", "way": 0 }},
    nodes: {{ "m": (0, 0, 0) }},
    supports: {{ "m": (Uz, Ry) }},
    elements: {{
        "mass": Mass(node: "m", mass: "1 t"),
        "link": {link},
    }},
    cases: {{ "kick": Dynamic(duration: "0.3 s", dt: "5 ms",
        initial: [(node: "m", dof: Ux, velocity: "v")]) }},
    outputs: {{ "x": Displacement(node: "m", dof: Ux) }},
)""",
        laws=laws,
        parameters=parameters,
    )


ALONG = "axis1: (1, 0, 0)"
SLIDER = f'Slider(node: "m", k: "100 kN/m", {ALONG})'


@pytest.fixture(params=WAYS, ids=["plain", "compiled"][: len(WAYS)])
def slider(request: pytest.FixtureRequest) -> Any:
    """The law in each way in which it can be called."""
    return type("Slider", (Slider,), {"compiled": request.param, "__doc__": Slider.__doc__})


def test_a_law_is_a_kind_of_its_model(slider: Any) -> None:
    m = model(SLIDER, [slider])
    assert m.links == ["link"] and m.elements["link"].kind == "Slider" and m.laws == (slider,)
    r = m.run()
    assert r.status == "converged" and r.energy.error_relative < 1e-3
    d, f = r.links["link"].loop("U1")
    slip = np.zeros_like(d)
    for i in range(1, len(d)):
        q = np.clip(1e5 * (d[i] - slip[i - 1]), -500, 500)
        slip[i] = d[i] - q / 1e5
        assert f[i] == pytest.approx(q, abs=0.5)
    assert max(abs(f)) == pytest.approx(500) and r.energy.totals["link_hysteretic"] > 50
    # Nothing is global: without the law the model is refused.
    with pytest.raises(tl.ModelError, match="Slider"):
        model(SLIDER, [])


def test_plain_and_compiled_agree_to_the_bit() -> None:
    runs = []
    for way in WAYS:
        law = type("Slider", (Slider,), {"compiled": way})
        r = model(SLIDER, [law]).run()
        runs.append((r["x"].tobytes(), r.energy.totals["link_hysteretic"]))
    assert all(run == runs[0] for run in runs)


def test_its_card_is_like_every_card(slider: Any) -> None:
    card = tl.elements([slider])["Slider"]
    assert card.summary == "Spring that slips." and card.law.startswith("f = k (d - p)")
    k, fy = card.parameters
    assert (k.unit, k.range, k.required) == ("N/m", "> 0", True)
    assert (fy.default, fy.required, fy.meaning) == ("500", False, "force at which it slips")
    assert (card.coordinates, card.history) == ("U1", "slip [m]")
    assert "Slider" not in tl.elements()
    with pytest.raises(tl.ModelError, match="N/m"):
        model(f'Slider(node: "m", k: "1 kN", {ALONG})', [slider])
    with pytest.raises(tl.ModelError, match="> 0"):
        model(f'Slider(node: "m", k: -1, {ALONG})', [slider])
    with pytest.raises(tl.ModelError, match="did you mean `fy`"):
        model(f'Slider(node: "m", k: 1, f: 1, {ALONG})', [slider])


def test_a_class_builds_elements_as_those_of_the_package_do() -> None:
    m = tl.Model(
        plane="XZ",
        nodes={"m": (0, 0, 0)},
        supports={"m": ("Uz", "Ry")},
        elements={
            "mass": tl.Mass(node="m", mass="1 t"),
            "link": Silent(node="m", k="100 kN/m", axis1=(1, 0, 0)),
        },
        cases={"rest": tl.Static(loads=[])},
        laws=[Silent],
    )
    assert 'Silent(node: "m", k: "100 kN/m"' in m.text


def test_the_kit_is_led_along_a_law(slider: Any) -> None:
    report = tl.conform(slider, k="100 kN/m", rate_independent=True, paths=2)
    assert report.tangents > 50 and report.energy_error is not None and report.energy_error < 2e-3
    assert report.coordinates == ("U1",)
    report = tl.conform(Silent, k="100 kN/m", amplitude="2 cm", paths=1)
    assert report.energy_error is None
    assert tl.conform("Wen", paths=1).tangents > 10
    for way in WAYS:
        law = type("Coupled", (Coupled,), {"compiled": way})
        assert tl.conform(law, k="1 kN/m", c="50 N*s/m", paths=1).coordinates == ("U2", "U3")


def test_the_kit_finds_a_wrong_tangent_and_a_wrong_energy() -> None:
    def tangent(self: Any, d: Any, v: Any, history: Any) -> Any:
        return 1.01 * Slider.tangent(self, d, v, history)

    def energy(self: Any, d: Any, v: Any, history: Any, step: Any) -> Any:
        stored, heat, _ = Slider.energy(self, d, v, history, step)
        return 2 * stored, heat, 0.0

    law = type("Slider", (Slider,), {"tangent": tangent, "compiled": False})
    with pytest.raises(tl.ConformanceError, match=r"k\[0\]\[0\] = 1\.01e5, and the difference quotient is"):
        tl.conform(law, k="100 kN/m", paths=1)
    law = type("Slider", (Slider,), {"energy": energy, "compiled": False})
    with pytest.raises(tl.ConformanceError, match="stored"):
        tl.conform(law, k="100 kN/m", paths=1)


def test_differences_stand_for_a_tangent_and_work_for_energies() -> None:
    own = model(SLIDER, [type("Slider", (Slider,), {"compiled": False})]).run()
    r = model(f'Silent(node: "m", k: "100 kN/m", {ALONG})', [Silent]).run()
    assert r.status == "converged"
    assert r["x"] == pytest.approx(own["x"], abs=1e-5)
    assert any("does not tell its energies" in w and '"link" (Silent)' in w for w in r.warnings)
    assert not any("energies" in w for w in own.warnings)
    # What the link holds is within what counts as heat, and the ledger closes.
    assert r.energy.totals["link_stored"] == 0 and r.energy.error_relative < 1e-3


def test_a_law_that_holds_no_more_ends_the_run_with_its_words() -> None:
    r = model(f'Failing(node: "m", {ALONG})', [Failing]).run()
    assert r.status == "refused" and "torn at 20 mm" in r.message
    assert r["x"].max() == pytest.approx(0.02, abs=2e-3)


@pytest.mark.parametrize(
    ("way", "words", "cause"),
    [
        (1, r"Failing.force \(line \d+ of test_laws.py\) raised KeyError: 'nothing'", KeyError),
        (2, "gives no finite number .*: force of U1 is NaN", None),
        (3, r"Failing.force must return a force, a number: it returned \[1.0, 2.0\], of the shape \(2,\)", TypeError),
        (4, "Failing.force must return a force, a number: it returned 'much'", TypeError),
    ],
)
def test_a_law_that_goes_wrong_is_an_exception(way: int, words: str, cause: type | None) -> None:
    m = model(f'Failing(node: "m", way: "way", {ALONG})', [Failing], way=way)
    with pytest.raises(tl.LawError, match=words) as e:
        m.run()
    assert 'the law of "link"' in str(e.value) and "Failing" in str(e.value)
    assert type(e.value.__cause__) is (cause or type(None))
    # What was found until there is kept.
    assert e.value.result is not None and 0 < e.value.result["x"].max() <= 0.021
    assert isinstance(e.value, tl.RunError)


@pytest.mark.parametrize("given", [(1e5,), [[1e5, 0.0]], "much"])
def test_a_tangent_of_another_shape_is_an_exception(given: Any) -> None:
    class Bent(tl.Law):
        """Its tangent is no number."""

        rates = False
        compiled = False

        def force(self, d: Any, v: Any, history: Any) -> Any:
            return 1e5 * d[0]

        def tangent(self, d: Any, v: Any, history: Any) -> Any:
            return given

    with pytest.raises(tl.LawError, match="Bent.tangent must return ∂f/∂d"):
        model(f'Bent(node: "m", {ALONG})', [Bent]).run()


@with_numba
def test_what_is_raised_where_it_is_compiled_is_told_as_in_python() -> None:
    class Checks(tl.Law):
        """Ends, or goes wrong, from some deformation on."""

        wrong: float = tl.parameter()
        rates = False
        compiled = True

        def force(self, d: Any, v: Any, history: Any) -> Any:
            if d[0] > 0.02:
                if self.wrong > 0:
                    raise ValueError("beyond")
                raise tl.Refusal("torn")
            return 1e5 * d[0]

        def energy(self, d: Any, v: Any, history: Any) -> Any:
            return 0.5e5 * d[0] ** 2, 0.0, 0.0

    with pytest.raises(tl.LawError, match=r"Checks.force \(line .*\) raised ValueError: beyond") as e:
        model(f'Checks(node: "m", wrong: 1, {ALONG})', [Checks]).run()
    assert isinstance(e.value.__cause__, ValueError) and e.value.__cause__.__traceback__ is not None
    r = model(f'Checks(node: "m", wrong: 0, {ALONG})', [Checks]).run()
    assert r.status == "refused" and ": torn" in r.message


@with_numba
def test_what_cannot_be_compiled_stays_python_and_says_so() -> None:
    class Texts(tl.Law):
        """Has a method of its own."""

        rates = False

        def ten(self) -> float:
            """10."""
            return 10.0

        def force(self, d: Any, v: Any, history: Any) -> Any:
            return getattr(self, "ten")() * 1e4 * d[0]

        def energy(self, d: Any, v: Any, history: Any) -> Any:
            return 0.5e5 * d[0] ** 2, 0.0, 0.0

    with pytest.warns(RuntimeWarning, match="Texts stays plain Python"):
        m = model(f'Texts(node: "m", {ALONG})', [Texts])
    assert m.run().status == "converged"
    Texts.compiled = True
    with pytest.raises(tl.ArgumentError, match="Texts cannot be compiled by numba"):
        model(f'Texts(node: "m", {ALONG})', [Texts])


@with_numba
def test_inputs_of_a_compiled_law_are_to_be_read_only() -> None:
    class Writes(tl.Law):
        """Writes where it should read."""

        compiled = True

        def force(self, d: Any, v: Any, history: Any, step: Any) -> Any:
            step.d0[0] = 1.0
            return d[0]

    with pytest.raises(tl.ArgumentError, match="readonly"):
        tl.conform(Writes)


def test_a_sweep_on_many_threads_is_the_same_to_the_bit(slider: Any) -> None:
    m = model(SLIDER, [slider])
    one, many = (tl.sweep(m, {"v": np.linspace(0.2, 2, 6)}, threads=n) for n in (1, 4))
    assert one["x"].tobytes() == many["x"].tobytes() and one.good.all()
    wrong = tl.sweep(model(f'Failing(node: "m", way: "way", {ALONG})', [Failing]), {"way": [0, 1, 9]}, threads=2)
    assert wrong.status == ["refused", "wrong law", "converged"]
    assert "raised KeyError" in wrong.messages[1]


def test_threads_and_pickles_and_other_parameters(slider: Any) -> None:
    m = model(SLIDER, [slider])
    first = m.run()["x"].tobytes()
    found: list[bytes] = []
    threads = [threading.Thread(target=lambda: found.append(m.run()["x"].tobytes())) for _ in range(4)]
    for t in threads:
        t.start()
    for t in threads:
        t.join()
    assert found == [first] * 4
    other = m.with_parameters(v=2)
    assert other.laws == (slider,) and other.run()["x"].max() > m.run()["x"].max()
    assert copy.copy(m) is m
    again = pickle.loads(pickle.dumps(model(f'Silent(node: "m", k: "100 kN/m", {ALONG})', [Silent])))
    assert again.laws == (Silent,) and again.run().status == "converged"
    e = tl.exercise(slider, amplitude="2 cm", k="100 kN/m")
    assert e.history["slip"].max() > 0 and e.energy_error < 1e-2


LONG = """
import os, signal, sys, threading, time
import trilith as tl

class Slow(tl.Law):
    compiled = False
    rates = False
    def force(self, d, v, history):
        return 1e5 * d[0]
    def energy(self, d, v, history):
        return 0.5e5 * d[0] ** 2, 0.0, 0.0

m = tl.loads('''(plane: XZ, nodes: {"m": (0, 0, 0)}, supports: {"m": (Uz, Ry)},
    elements: {"mass": Mass(node: "m", mass: "1 t"), "link": Slow(node: "m", axis1: (1, 0, 0))},
    cases: {"kick": Dynamic(duration: "20000 s", dt: "1 ms", initial: [(node: "m", dof: Ux, velocity: 1)])},
    outputs: {"x": Displacement(node: "m", dof: Ux)})''', laws=[Slow])
threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
start = time.monotonic()
try:
    m.run(histories=False)
except KeyboardInterrupt:
    print("stopped", time.monotonic() - start < 30)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="signals of Unix")
def test_ctrl_c_ends_a_run_of_a_plain_law_and_the_process_goes_in_peace() -> None:
    done = subprocess.run([sys.executable, "-c", LONG], capture_output=True, text=True, timeout=120, check=False)
    assert (done.returncode, done.stdout) == (0, "stopped True\n"), done.stderr
    assert signal.SIGINT  # the signal that Ctrl-C is


def _with(**members: Any) -> Any:
    """A law with these members."""

    def force(self: Any, d: Any, v: Any, history: Any) -> Any:
        return d[0]

    return type("Other", (tl.Law,), {"force": force, "compiled": False, **members})


@pytest.mark.parametrize(
    ("law", "words"),
    [
        (3, "3 is no law"),
        (tl.Law, "is no law"),
        (_with(force=None), "a law has a method force"),
        (_with(force=lambda self, d: 0), r"Other: force takes \(self, d, v, history\[, step\]\)"),
        (_with(engaged=lambda self, d: 0), r"Other: engaged takes \(self\)"),
        (_with(axes=("U9",)), "its coordinates `U9` must be one or more of U1"),
        (_with(history=["slip"]), "history is a dict"),
        (_with(history={"a b": "m"}), "'a b' is no name"),
        (_with(history={"a": "inch"}), "the unit `inch` of `a` is none of SI"),
        (_with(k=tl.parameter("kN/m")), "the unit `kN/m` of `k` is none of SI"),
        (_with(k=tl.parameter("N/m", range="positive")), "the range of k is 'positive'"),
        (_with(k=tl.parameter("N/m", default="1 m")), "must be in N/m"),
        (_with(force=lambda self, d, v, history: 0, energy=tl.parameter()), "energy"),
        (type("Some", (_with(),), {}), "`Some` is a word of model files"),
        (_with(axis1=tl.parameter()), "must not be called `axis1`"),
        (_with(amplitude=(1.0, 2.0)), "1 positive numbers"),
        (type("Gap", (_with(),), {}), "called `Gap`, as a built-in kind is"),
    ],
)
def test_laws_that_cannot_be_say_why(law: Any, words: str) -> None:
    with pytest.raises(tl.ArgumentError, match=words):
        tl.loads("()", laws=[law])
    with pytest.raises(tl.ArgumentError, match="laws is a list"):
        tl.loads("()", laws=Silent)  # type: ignore[arg-type]


def test_parameters_that_do_not_go_together_are_told_at_their_place() -> None:
    def check(self: Any) -> None:
        if self.a > self.b:
            raise ValueError("a must not be more than b")

    law = _with(a=tl.parameter(), b=tl.parameter(default=1.0), check=check)
    assert model(f'Other(node: "m", a: 1, {ALONG})', [law]).links == ["link"]
    with pytest.raises(tl.ModelError, match="a must not be more than b") as e:
        model(f'Other(node: "m", a: 2, {ALONG})', [law])
    assert e.value.diagnostics[0].line == 8 and isinstance(e.value.__cause__, ValueError)


def test_a_study_goes_on_with_the_same_law_alone(tmp_path: Path) -> None:
    m = model(f'Silent(node: "m", k: "100 kN/m", {ALONG})', [Silent])
    (tmp_path / "m.ron").write_text(m.text)
    (tmp_path / "s.ron").write_text('(title: "kicks", model: "m.ron", axes: { "v": [0.5, 1] }, columns: { "x": Peak("x") })')
    s = tl.study(tmp_path / "s.ron", out=tmp_path / "out", laws=[Silent])
    assert s.runs == 2 and s.failed == 0
    assert tl.study(tmp_path / "s.ron", out=tmp_path / "out", laws=[Silent]).resumed == 2
    other = type("Silent", (Silent,), {"force": lambda self, d, v, history: (d[0], history)})
    with pytest.raises(tl.FileError, match="the build of the program"):
        tl.study(tmp_path / "s.ron", out=tmp_path / "out", laws=[other])


@pytest.fixture(scope="module")
def library(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The law in C of the guide, compiled."""
    compiler = shutil.which("cc") or pytest.skip("there is no C compiler here")
    folder = tmp_path_factory.mktemp("c")
    (folder / "trilith_link.h").write_text(tl.c_header())
    source = ROOT / "crates/foreign/tests/yielding.c"
    out = folder / "libyielding.so"
    subprocess.run([compiler, "-shared", "-fPIC", "-O2", "-I", folder, source, "-o", out, "-lm"], check=True)
    return out


def test_laws_in_c(library: Path) -> None:
    laws = tl.c_laws(library)
    [law] = laws
    assert law.kind == "Yielding" and "Yielding" in repr(law)
    element = law(node="m", k="100 kN/m", fy="0.5 kN", axis1=(1, 0, 0))
    m = model(repr(element), laws)
    r = m.run()
    assert r.status == "converged" and r.energy.error_relative < 1e-3
    # As in Python, but for the last bits of its dashpot, which is zero here.
    own = model(SLIDER, [type("Slider", (Slider,), {"compiled": False})]).run()
    assert r["x"] == pytest.approx(own["x"], abs=1e-5)
    assert tl.conform(law, k="100 kN/m", fy="0.5 kN", paths=1).energy_error is not None
    again = pickle.loads(pickle.dumps(m))
    assert again.run()["x"].tobytes() == r["x"].tobytes()
    torn = model(repr(law(node="m", k="100 kN/m", fy="0.5 kN", torn="5.1 mm", axis1=(1, 0, 0))), laws).run()
    assert torn.status == "refused" and "torn" in torn.message
    with pytest.raises(tl.FileError, match="cannot be opened"):
        tl.c_laws(library.with_name("libnone.so"))
    with pytest.raises(tl.FileError, match="cannot be opened"):
        tl.c_laws(library.with_name("trilith_link.h"))
