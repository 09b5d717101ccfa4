"""Graphs of a model: its states in networkx, views of them, drawings of views. The home of networkx.

from mmsverify.graph import explore, views, svg
"""

from mmsverify.graph.explore import explore
from mmsverify.graph.svg import svg
from mmsverify.graph.text import dot, mermaid
from mmsverify.graph.views import Arrow, View, view_names, views

__all__ = ["Arrow", "View", "dot", "explore", "mermaid", "svg", "view_names", "views"]
