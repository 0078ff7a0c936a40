from ._ron import Word
WORDS = frozenset({"dof"})
X = Word("X")
__all__ = ["X"]
