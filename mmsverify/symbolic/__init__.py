"""The Z3 reader of a model: translate rows, prove or refute claims for any number of elements. The only folder that imports z3."""
