"""What a request can say: parameters of a row that no message can carry together."""

from __future__ import annotations

from collections.abc import Iterator

from mmsverify.model import Row
from mmsverify.model import expr as ex
from mmsverify.model.expr import Cell, Expr, Ref
from mmsverify.model.rewrite import bind
from mmsverify.model.sorts import BOOL, EnumSort
from mmsverify.model.terms import SetOf


def sayable(row: Row) -> Iterator[Expr]:
    """What a request can say: parameters that no message can carry together are kept apart."""
    has = {parameter.name: parameter for parameter in row.parameters}

    def flag(name: str) -> Expr:
        found = has[name]
        assert isinstance(found, Ref)
        return found

    limited: Expr = ex.Present("limit")
    if "limit" in has:
        mode = has["limit"]
        assert isinstance(mode, Ref)
        assert isinstance(mode.of, EnumSort)
        free = ex.conjunction(limited, ex.equal(mode, ex.Const(mode.of.members[0], mode.of)))
        none = ex.equal(flag("count"), ex.Const(0, flag("count").sort))
        yield ex.disjunction(ex.conjunction(limited, ex.negation(free)), none)
    if "location_given" in has:
        yield ex.disjunction(ex.negation(flag("location_given")), limited)
    if "type_given" in has:
        yield ex.disjunction(flag("type_given"), ex.negation(limited))
    if row.on.service == "alterPI":
        yield limited
    if "named_twice" in has:
        controlled = has["controlled"]
        assert isinstance(controlled, SetOf)
        one = Ref("one", controlled.of)
        some = bind(False, (one,), ex.Member("controlled", one))
        yield ex.disjunction(ex.negation(flag("named_twice")), some)
        yield ex.disjunction(ex.negation(some), ex.Present("controlling"))
    if "binds_arm" in has:
        domains = has["domains"]
        assert isinstance(domains, SetOf)
        one = Ref("one", domains.of)
        arm = bind(False, (one,), ex.conjunction(ex.Member("domains", one), Cell("arm_domain", (one,), BOOL)))
        yield ex.equal(flag("binds_arm"), arm)
        yield bind(False, (one,), ex.Member("domains", one))
