"""Campaigns: one scene, many settings, every core or a cluster. docs/campaigns.md."""

from .plan import Plan, load_plan
from .store import Store
from .table import gather

__all__ = ["Plan", "Store", "gather", "load_plan"]
