"""The clause register: by statement of a standard, what encodes it, which tests and samples exercise it.

Computed from the models, from the tables of rules, from the ASN.1 modules and from the profile keys. Only the
statements themselves are written down, in words of the project's own, and why one of them cannot be checked.
"""

from mmsverify.register.compose import clause_registers
from mmsverify.register.statements import REASONS

__all__ = ["REASONS", "clause_registers"]
