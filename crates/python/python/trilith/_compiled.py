"""Laws compiled by numba: machine code that the library calls by its address.

The code has the signature of ``trilith_respond`` in ``trilith_link.h``. Whatever is raised in it comes back as a status other than
0; the library asks the law in plain Python then, whose exception says what is wrong.
"""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any

from ._errors import ArgumentError

if TYPE_CHECKING:
    from ._law import Plain


def address_of(plain: Plain, *, must: bool) -> tuple[int, object] | None:
    """The address of a law, and what holds its code; nothing where it stays plain Python.

    :param must: an error where it cannot be compiled.
    :raises ArgumentError: then.
    """
    try:
        import numba
    except ImportError as e:
        if must:
            raise ArgumentError(f"{plain.kind} is to be compiled, and numba is not installed: {e}") from e
        return None
    try:
        code = _compiled(plain, numba)
    except Exception as e:  # whatever numba raises
        said = " ".join(str(e).split())
        if must:
            raise ArgumentError(f"{plain.kind} cannot be compiled by numba: {said}") from e
        short = said if len(said) < 400 else said[:400] + " …"
        warnings.warn(
            f"{plain.kind} stays plain Python, as numba cannot compile it (`compiled = False` in the class says that it should): {short}",
            RuntimeWarning,
            stacklevel=2,
        )
        return None
    return int(code.address), code


def _compiled(plain: Plain, numba: Any) -> Any:
    """The law as a C function."""
    from ._law import LawStep

    types, law, n, h = numba.types, plain.law, plain.n, plain.h
    real = types.float64
    # What a law is given is to be read.
    reads = types.Array(real, 1, "C", readonly=True)
    writes = types.Array(real, 1, "C")

    def tuple_of(names: Any, count: int) -> Any:
        return types.NamedUniTuple(real, count, names) if count else types.Tuple(())

    self_type, memory_type = tuple_of(plain.values, len(plain.parameters)), tuple_of(plain.memory, h)
    step_type = types.NamedTuple([reads, reads, real, memory_type], LawStep)

    def method(name: str) -> Any:
        step = [step_type] if plain.stepped[name] else []
        jit = numba.njit((self_type, reads, reads, memory_type, *step), boundscheck=True, error_model="numpy")
        return jit(getattr(law, name))

    place = {
        "carray": numba.carray,
        # A list that is only to be read, of one that may be written: inside a step nothing else makes it one.
        "reads": numba.njit(reads(reads))(_same),
        **_putters(numba),
        "Self": plain.values,
        "Memory": plain.memory,
        "Step": LawStep,
    }
    rates = bool(law.rates)
    place["force"] = method("force")
    forced = place["force"].overloads
    [of_force] = [overload.signature.return_type for overload in forced.values()]
    told = h > 0
    if told and not (isinstance(of_force, types.BaseTuple) and len(of_force) == 2):
        raise TypeError(f"force must return forces and history, and it returns {of_force}")
    lines = ["f_, h_ = " + _call(plain, "force", "memory"), "put(f, f_)", "put(trial, h_)"]
    if not told:
        lines = ["put(f, " + _call(plain, "force", "memory") + ")"]
    if "tangent" in plain.stepped:
        place["tangent"] = method("tangent")
        call = _call(plain, "tangent", "memory")
        square = f"put_square({{}}, {n})"
        if rates:
            lines += ["k_, c_ = " + call, square.format("k, k_"), square.format("c, c_")]
        else:
            lines.append(square.format(f"k, {call}"))
    if "energy" in plain.stepped:
        place["energy"] = method("energy")
        if told:
            lines.append("end = " + _tuple("Memory", "trial", h))
        lines.append("put(energy_, " + _call(plain, "energy", "end" if told else "memory") + ")")
    arrays = [("d", "d_", n), ("v", "v_", n), ("d0", "d0_", n), ("v0", "v0_", n)]
    outs = [("f", "f_", n), ("k", "k_", n * n), ("c", "c_", n * n), ("energy_", "e_", 3), ("trial", "t_", max(h, 1))]
    ins = [("p", "p_", max(len(plain.parameters), 1)), ("h", "h_", max(h, 1))]
    # Names of the pointers are other ones than those of the lists.
    views = [f"{a} = carray({pointer}ptr, ({size},))" for a, pointer, size in [*arrays, *outs, *ins]]
    body = [
        *views,
        "self = " + _tuple("Self", "p", len(plain.parameters)),
        "memory = " + _tuple("Memory", "h", h),
        "step = Step(reads(d0), reads(v0), dt, memory)",
        *lines,
        "return 0",
    ]
    source = (
        "def respond(p_ptr, d_ptr, v_ptr, d0_ptr, v0_ptr, dt, h_ptr, t_ptr, f_ptr, k_ptr, c_ptr, e_ptr):\n    try:\n"
        + "".join(f"        {line}\n" for line in body)
        + "    except Exception:\n        return -1\n"
    )
    exec(compile(source, f"<compiled law {plain.kind}>", "exec"), place)
    pointer = types.CPointer(real)
    takes = [pointer] * 5 + [real] + [pointer] * 6
    return numba.cfunc(types.int32(*takes), error_model="numpy")(place["respond"])


def _same(x: Any) -> Any:
    return x


def _tuple(name: str, of: str, count: int) -> str:
    return f"{name}({', '.join(f'{of}[{i}]' for i in range(count))})" if count else "()"


def _call(plain: Plain, name: str, history: str) -> str:
    return f"{name}(self, d, v, {history}{', step' if plain.stepped[name] else ''})"


_PUT: dict[str, Any] = {}


def _putters(numba: Any) -> dict[str, Any]:
    """Functions of compiled code that put what a law returns into lists: ``put`` a number or as many as there is room for,
    ``put_square`` a number or a square matrix."""
    if _PUT:
        return _PUT

    def put(to: Any, value: Any) -> None: ...

    def put_square(to: Any, value: Any, n: int) -> None: ...

    types, wrong = numba.types, numba.errors.TypingError
    number = (types.Float, types.Integer, types.Boolean)

    def bare(function: Any) -> Any:
        # Numba compares annotations, and what is made of text below has none.
        function.__annotations__ = {}
        return function

    def made(arguments: str, wanted: str, places: list[str]) -> Any:
        text = f"def put({arguments}):\n    if {wanted}:\n        raise ValueError('another length')\n"
        space: dict[str, Any] = {}
        exec(text + "".join(f"    to[{i}] = {at}\n" for i, at in enumerate(places)), space)
        return space["put"]

    def of_put(to: Any, value: Any) -> Any:
        if isinstance(value, number):
            return made("to, value", "len(to) != 1", ["value"])
        if isinstance(value, types.BaseTuple) and all(isinstance(x, number) for x in value):
            places = [f"value[{i}]" for i in range(len(value))]
            return made("to, value", f"len(to) != {len(places)}", places)
        if isinstance(value, types.Array) and value.ndim == 1:

            def of_list(to: Any, value: Any) -> None:
                if len(value) != len(to):
                    raise ValueError("another length")
                for i in range(len(to)):
                    to[i] = value[i]

            return bare(of_list)
        raise wrong(f"numbers are wanted here, not {value}")

    def of_square(to: Any, value: Any, n: Any) -> Any:
        if isinstance(value, number):
            return made("to, value, n", "n != 1", ["value"])
        rows = list(value) if isinstance(value, types.BaseTuple) else []
        m = len(rows)
        if rows and all(isinstance(r, types.BaseTuple) and len(r) == m and all(isinstance(x, number) for x in r) for r in rows):
            places = [f"value[{i}][{j}]" for i in range(m) for j in range(m)]
            return made("to, value, n", f"n != {m}", places)
        if isinstance(value, types.Array) and value.ndim == 2:

            def of_matrix(to: Any, value: Any, n: Any) -> None:
                if value.shape != (n, n):
                    raise ValueError("another shape")
                for i in range(n):
                    for j in range(n):
                        to[i * n + j] = value[i, j]

            return bare(of_matrix)
        raise wrong(f"a square matrix is wanted here, not {value}")

    numba.extending.overload(put)(bare(of_put))
    numba.extending.overload(put_square)(bare(of_square))
    _PUT.update(put=put, put_square=put_square)
    return _PUT
