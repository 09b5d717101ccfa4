"""The Z3 reader of a model: translate rows, prove claims for any number of elements. The one home of z3."""
