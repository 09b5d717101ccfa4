"""Where a text breaks its own rules: every property against every procedure.

Beside them: what cannot be reached, and what is left open.

A composition root beside ``checking``: it asks the prover where to look and the search for the shortest run.

    from mmsverify.faults import find_faults
"""

from mmsverify.faults.survey import find_faults

__all__ = ["find_faults"]
