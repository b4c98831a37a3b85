"""The paper's claims, each beside what was found here: the page that ``make paper`` writes."""
