"""The paper's reproduction: its values, tables and claims. Nothing imports it."""
