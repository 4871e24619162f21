"""Words of laboratories in several languages, and what names that are put together of them mean."""
