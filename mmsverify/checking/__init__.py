"""Checking models: proofs for any number of elements, then runs in small worlds; each claim gets a verdict.

The composition root of ``check``: here the prover and the search meet, and nowhere else.

    from mmsverify.checking import check_models
"""

from mmsverify.checking.models import check_models
from mmsverify.checking.traces import write_counterexamples

__all__ = ["check_models", "write_counterexamples"]
