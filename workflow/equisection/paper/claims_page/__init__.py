"""The paper's claims, each with this project's finding: the page that ``make paper`` writes."""
