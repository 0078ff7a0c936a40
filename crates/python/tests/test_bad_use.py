"""Bad use ends in an exception that says what is wrong: never in an abort, never in a hang."""

from __future__ import annotations

import pickle
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
from conftest import FOOT, LONG, MODELS

import trilith as tl
from trilith import _native


def test_errors_of_a_file_have_the_text_of_the_program(tmp_path: Path) -> None:
    path = tmp_path / "wrong.ron"
    path.write_text(FOOT.replace("inertia: (0, 1, 0)", "inerta: (0, 1, 0)"), encoding="utf-8")
    with pytest.raises(tl.ModelError) as e:
        tl.load(path)
    command = [sys.executable, "-m", "trilith", "check", str(path)]
    told = subprocess.run(command, capture_output=True, text=True, check=False).stderr
    assert str(e.value).strip() == told.strip()
    assert "^^^^^^" in told and "did you mean" in told
    [d] = e.value.diagnostics
    assert (d.code, d.line, d.level) == ("E0103", 6, "error") and d.help and "inertia" in d.help
    assert str(path) == d.file and str(d).startswith(f"{path}:6:")
    assert isinstance(e.value, ValueError)
    again = pickle.loads(pickle.dumps(e.value))
    assert str(again) == str(e.value) and again.diagnostics == e.value.diagnostics


def test_files_that_are_not_there_or_no_models() -> None:
    with pytest.raises(tl.ModelError, match="cannot be read"):
        tl.load("no/such/model.ron")
    with pytest.raises(tl.ModelError):
        tl.load(MODELS)
    with pytest.raises(tl.ModelError):
        tl.loads("")
    with pytest.raises(TypeError):
        tl.loads(b"()")  # type: ignore[arg-type]
    with pytest.raises(TypeError):
        tl.load(3)  # type: ignore[arg-type]
    with pytest.raises(ValueError):
        tl.load("a\0b.ron")


@pytest.mark.parametrize(
    ("value", "told"),
    [
        (float("nan"), "nan"),
        (float("inf"), "inf"),
        ("1 kg", "kg"),
        ("1 +", "is wanted here"),
    ],
)
def test_values_of_parameters_that_are_none(foot: tl.Model, value: object, told: str) -> None:
    with pytest.raises(tl.ModelError, match=told):
        foot.with_parameters(mu=value)


def test_values_of_parameters_of_a_wrong_type(foot: tl.Model) -> None:
    for value in (None, [0.1], np.zeros(2), 1j, object()):
        with pytest.raises(tl.ArgumentError, match="'mu' must be a number or a text"):
            foot.with_parameters(mu=value)
    with pytest.raises(tl.ModelError, match="did you mean `mu`"):
        foot.with_parameters(nu=0.1)


def test_arguments_of_runs(foot: tl.Model) -> None:
    with pytest.raises(tl.ArgumentError, match="did you mean `shake`"):
        foot.run("shaken")
    with pytest.raises(tl.ArgumentError, match='no solver "fnaa"'):
        foot.run(solver="fnaa")
    for dt in (0.0, -1.0, float("nan"), float("inf")):
        with pytest.raises(tl.ArgumentError, match="dt must be a finite number above 0"):
            foot.run(dt=dt)
    with pytest.raises(tl.ArgumentError, match="dt is no number"):
        foot.run(dt="soon")  # type: ignore[arg-type]
    with pytest.raises(tl.ArgumentError, match="vectors"):
        foot.run(vectors=0)
    with pytest.raises(tl.ArgumentError, match="frames"):
        foot.run(frames=-1)
    with pytest.raises(TypeError):
        foot.run(start=3)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="unexpected keyword"):
        foot.run(slver="fna")  # type: ignore[call-arg]
    with pytest.raises(tl.TrilithError, match="output steps"):
        foot.run(dt=1e-12)


def test_structures_that_are_none_and_runs_that_cannot_be_made() -> None:
    loose = FOOT.replace('"upright": Spring(node: "cg", r3: "1 MN*m"),', "")
    with pytest.raises(tl.ModelError) as e:
        tl.loads(loose).run("gravity")
    assert "-->" in str(e.value) and e.value.diagnostics[0].line > 0
    # Own weight on a slope that friction does not hold: no static equilibrium.
    slope = FOOT.replace('"gravity": Static(loads: [Gravity])', '"gravity": Static(loads: [Gravity, (load: "push")])')
    slope = slope.replace("cases:", 'loads: { "push": [(node: "cg", dof: Ux, force: "5 kN")] }, cases:')
    with pytest.raises(tl.RunError, match="no equilibrium"):
        tl.loads(slope).run()


def test_what_a_progress_raises_ends_the_run() -> None:
    def stop(share: float) -> None:
        raise LookupError(f"enough at {share >= 0}")

    before = time.monotonic()
    with pytest.raises(LookupError, match="enough at True"):
        tl.loads(LONG).run(progress=stop)
    assert time.monotonic() - before < 20


def test_a_panic_is_an_exception(capfd: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(tl.InternalError, match="on purpose"):
        _native.panic_for_a_test()
    capfd.readouterr()


INTERRUPTED = """
import signal, sys, threading, time
import trilith as tl
from conftest import LONG

# What was started in the background has it ignored.
signal.signal(signal.SIGINT, signal.default_int_handler)
m = tl.loads(LONG)
call = {"run": lambda: m.run(), "sweep": lambda: tl.sweep(m, {"mu": [0.1 + 1e-3 * i for i in range(64)]}),
        "compare": lambda: m.compare(["fna", "hht"]), "gradient": lambda: m.gradient(by=["mu"]),
        "optimize": lambda: m.optimize({"mu": (0.1, 0.5)}, "slide")}[sys.argv[1]]
sent = []

def soon():
    time.sleep(0.7)
    sent.append(time.monotonic())
    signal.raise_signal(signal.SIGINT)

threading.Thread(target=soon).start()
try:
    call()
    print("came to its end")
except KeyboardInterrupt:
    print("answered after", time.monotonic() - sent[0], threading.active_count())
# What was interrupted is in nobody's way.
r = m.run(until=0.5, errors=False)
print(r.status, len(r.t))
"""


@pytest.mark.skipif(sys.platform == "win32", reason="signals are another matter there")
@pytest.mark.parametrize("what", ["run", "sweep", "compare", "gradient", "optimize"])
def test_ctrl_c_is_answered_at_once(what: str) -> None:
    command = [sys.executable, "-c", INTERRUPTED, what]
    here = Path(__file__).parent
    done = subprocess.run(command, cwd=here, capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 0, done.stderr
    first, last = done.stdout.splitlines()
    answered = first.split()
    assert answered[:2] == ["answered", "after"], done.stdout
    assert last == "converged 501"


def test_an_interrupted_study_goes_on(tmp_path: Path) -> None:
    (tmp_path / "foot.ron").write_text(FOOT, encoding="utf-8")
    study = tmp_path / "many.ron"
    axes = '"mu": Range(from: 0.1, to: 0.3, count: 20), "a": Range(from: 2, to: 6, count: 20)'
    study.write_text(f'(model: "foot.ron", axes: {{ {axes} }}, columns: {{ "slide": Peak("slide") }})', encoding="utf-8")
    code = (
        "import signal, sys, trilith as tl\n"
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        "def stop(share):\n"
        "    if share > 0: signal.raise_signal(signal.SIGINT)\n"
        f"tl.study({str(study)!r}, out={str(tmp_path / 'out')!r}, progress=stop, threads=1)\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=300, check=False)
    assert "KeyboardInterrupt" in done.stderr
    found = tl.study(study, out=tmp_path / "out")
    assert 0 < found.resumed < found.runs == 400 and found.failed == 0


def test_threads_do_not_disturb_each_other(foot: tl.Model) -> None:
    """One model from many threads at once; the interpreter goes on in the meantime."""
    alone = [foot.with_parameters(mu=mu).run()["slide"] for mu in (0.1, 0.2, 0.3, 0.4)]
    with ThreadPoolExecutor(8) as pool:
        again = list(pool.map(lambda i: foot.with_parameters(mu=(0.1, 0.2, 0.3, 0.4)[i % 4]).run()["slide"], range(16)))
        same = list(pool.map(lambda _: foot.run()["slide"], range(8)))
    assert all(np.array_equal(again[i], alone[i % 4]) for i in range(16))
    assert all(np.array_equal(s, alone[2]) for s in same)


def test_the_interpreter_goes_on_during_a_run() -> None:
    m = tl.loads(LONG)
    stop = threading.Event()
    raised: list[BaseException] = []

    def work() -> None:
        def until(share: float) -> None:
            if stop.is_set():
                raise StopIteration

        try:
            m.run(progress=until, errors=False)
        except BaseException as e:
            raised.append(e)

    thread = threading.Thread(target=work)
    thread.start()
    count, end = 0, time.monotonic() + 0.5
    while time.monotonic() < end:
        count += 1
    stop.set()
    thread.join(60)
    assert not thread.is_alive() and isinstance(raised[0], StopIteration)
    assert count > 1000


def test_a_stepper_in_two_threads_says_so() -> None:
    s = tl.loads(LONG).stepper()
    found: list[str] = []
    start = threading.Barrier(2)

    def work() -> None:
        start.wait()
        try:
            s.step(20000)
            found.append("done")
        except tl.ArgumentError as e:
            found.append(str(e))

    threads = [threading.Thread(target=work) for _ in range(2)]
    for t in threads:
        t.start()
    for t in threads:
        t.join(120)
    assert sorted(found)[0] == "done" and "another thread" in sorted(found)[1]


def test_a_fresh_process_imports_quickly_and_without_numpy() -> None:
    code = "import sys, trilith as tl; m = tl.loads; print('numpy' in sys.modules, 'json' in sys.modules)"
    told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    assert told.split() == ["False", "False"]


def test_the_handler_of_signals_is_left_alone(foot: tl.Model) -> None:
    before = signal.getsignal(signal.SIGINT)
    foot.run()
    tl.sweep(foot, {"mu": [0.1]})
    assert signal.getsignal(signal.SIGINT) is before
