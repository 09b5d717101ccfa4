"""Domains: download, upload, load from a file, deletion, as part 1 has them."""

from __future__ import annotations

from independent.controller import Controller
from independent.objects import CONFLICT, CONSTRAINT, EXISTS, UNKNOWN, Domain, Refusal


def known(robot: Controller, name: str) -> Domain:
    if name not in robot.domains:
        raise Refusal("unknown", UNKNOWN)
    return robot.domains[name]


def begin_download(robot: Controller, who: str, name: str, sharable: bool, segments: int) -> None:
    """InitiateDownloadSequence: from now on the robot asks for ``segments`` pieces."""
    if name in robot.domains:
        raise Refusal("exists", EXISTS)
    robot.domains[name] = Domain(name, sharable, state="loading", link=who, left=segments)


def load(robot: Controller, name: str, sharable: bool) -> None:
    """LoadDomainContent from a file of the robot."""
    if name in robot.domains:
        raise Refusal("exists", EXISTS)
    robot.domains[name] = Domain(name, sharable)


def delete(robot: Controller, name: str) -> None:
    """DeleteDomain."""
    domain = known(robot, name)
    if not domain.deletable:
        raise Refusal("not-deletable", CONSTRAINT)
    if domain.state != "ready" or robot.users(name):
        raise Refusal("domain-used", CONFLICT)
    if domain.uploads:
        raise Refusal("uploading", CONFLICT)
    del robot.domains[name]


def state(robot: Controller, domain: Domain) -> str:
    """The state that GetDomainAttributes tells."""
    return "in-use" if robot.users(domain.name) else domain.state
