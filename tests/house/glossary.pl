#!/usr/bin/perl
# Counts words that the project avoids, in comments, names and documents; strings do not count.
#
#   glossary.pl ROOT           counts by word, and the total
#   glossary.pl ROOT --files   counts by file as well
#   glossary.pl ROOT PATH...   each place in these files
#   glossary.pl ROOT --max N   fails if the total is above N
#
# A word of a name counts as a word: `distance_told` and `toldDistance` have "told".
use strict;
use warnings;

my %better = (
    'tell told tells telling'            => 'report, record, contain',
    'ask asks asked asking'              => 'query',
    'way ways'                           => 'displacement, offset, direction, path, method',
    'trade trades traded trading'        => 'swap',
    'beside'                             => 'next to, compared with',
    'anew'                               => 'again, from scratch',
    'apart parted'                       => 'separated',
    'mend mends mended mending'          => 'fix',
    'hence thereby whereof'              => 'two sentences',
    'nobody somebody'                    => 'the subject first, passive voice, or null',
    'studio court contender shelf ledger' => 'the term of the field or of other libraries',
);
my %advice;
for my $words (keys %better) { $advice{$_} = $better{$words} for split / /, $words }
my %phrases = (
    'of which'    => 'two sentences',
    'looked at'   => 'reviewed',
    'leaves with' => 'exits with status',
    'plain file'  => 'regular file',
);

my ($root, @rest) = @ARGV;
die "usage: glossary.pl ROOT [--files | --max N | PATH...]\n" unless defined $root;
chdir $root or die "cannot enter $root: $!\n";
my ($by_file, $max) = (0, undef);
if (@rest && $rest[0] eq '--files') { $by_file = 1; shift @rest }
if (@rest && $rest[0] eq '--max') { shift @rest; $max = shift @rest }

my @paths = @rest;
unless (@paths) {
    my @folders = ('src', 'render', 'tests', 'scenarios');
    @paths = ('README.md', 'CMakeLists.txt', grep { -e } 'CONTRIBUTING.md', 'CHANGELOG.md');
    while (defined(my $folder = shift @folders)) {
        opendir my $list, $folder or die "cannot list $folder: $!\n";
        for my $name (sort readdir $list) {
            next if $name =~ /^\./;
            my $path = "$folder/$name";
            if (-d $path) { push @folders, $path }
            elsif ($name =~ /\.(h|cpp|md|toml|sh|pl|cmake)$|^CMakeLists\.txt$/) { push @paths, $path }
        }
    }
    @paths = grep { $_ ne 'tests/house/glossary.pl' && !/^src\/package\/words\// } @paths;
}

my (%count, %files);
my $total = 0;

sub found {
    my ($path, $line, $what, $text) = @_;
    $count{$what}++;
    $files{$path}++;
    $total++;
    $text =~ s/^\s+//;
    my $say = $advice{$what} // $phrases{$what} // 'subject first; kMax, kMin';
    print "$path:$line: $what ($say): $text\n" if @rest;
}

sub words_in {
    my ($path, $line, $text, $shown) = @_;
    my $words = $text;
    $words =~ s/([a-z0-9])([A-Z])/$1 $2/g;
    $words =~ s/_/ /g;
    for my $word ($words =~ /[A-Za-z]+/g) {
        found($path, $line, lc $word, $shown) if exists $advice{lc $word};
    }
    for my $phrase (keys %phrases) { found($path, $line, $phrase, $shown) for $text =~ /\b$phrase\b/gi }
}

for my $path (@paths) {
    open my $file, '<', $path or die "cannot read $path: $!\n";
    my $source = $path =~ /\.(h|cpp)$/;
    my $document = $path =~ /\.md$/;
    my $in_comment = 0;
    my $raw = 0;
    while (my $line = <$file>) {
        chomp $line;
        my $number = $.;
        if ($document) { words_in($path, $number, $line, $line); next }
        my ($code, $comment) = ($line, '');
        if ($source) {
            if ($raw) { if ($code =~ s/^.*?\)["'\w]*"//) { $raw = 0 } else { $in_comment = 0; next } }
            $code =~ s/R"\w*\(.*?\)\w*"/ /g;
            if ($code =~ s/R"\w*\(.*$//) { $raw = 1 }
            $code =~ s/"(?:[^"\\]|\\.)*"/ /g;
            if ($code =~ s{//[/!<]*(.*)$}{}) { $comment = $1 }
            $code = '' if $code =~ /^\s*#\s*include/;
            found($path, $number, $1, $line) while $code =~ /\b(kMost|kLeast)/g;
            words_in($path, $number, $code, $line);
        } else {
            $code =~ s/"(?:[^"\\]|\\.)*"/ /g;
            $code =~ s/'[^']*'/ /g;
            $comment = $1 if $code =~ /(?:^|\s)#+(.*)$/;
        }
        if ($comment ne '') {
            words_in($path, $number, $comment, $line);
            my $opens = !$in_comment || $in_comment ne 'line';
            if ($opens && $comment =~ /^\s*(What|Of|Whose|Where it|That of)\b/) {
                found($path, $number, 'opens with What or Of', $line);
            }
        }
        $in_comment = ($comment ne '' && $code =~ /^\s*(#.*)?$/) ? 'line' : 0;
    }
}

if (!@rest) {
    printf "%6d  %s\n", $count{$_}, $_ for sort { $count{$b} <=> $count{$a} } keys %count;
}
if ($by_file) { printf "%6d  %s\n", $files{$_}, $_ for sort { $files{$b} <=> $files{$a} } keys %files }
print "$total in all\n";
if (defined $max && $total > $max) {
    print "At most $max are allowed: use the words of the right column (glossary.pl ROOT PATH shows each place).\n";
    exit 1;
}
